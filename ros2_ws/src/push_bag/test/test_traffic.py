"""Losses are counted from sequence numbers, also with several publishers on a topic."""

import random

import pytest
from push_bag.file.traffic import Traffic, lost_text


def counted(sequences):
    traffic = Traffic()
    for number, sequence in enumerate(sequences):
        traffic.add(sequence, (number + 1) * 100_000_000)
    return traffic


@pytest.mark.parametrize(
    ('sequences', 'lost'),
    [
        ([1, 2, 3], 0),
        ([1, 2, 5, 6, 8], 3),
        ([7, 8, 10], 1),
        ([1, 1, 2, 3, 2, 3, 4], 0),
        ([1, 2, 3, 1, 2, 5, 3, 4], 1),
        ([1, 2, 5, 3, 6, 4, 7], 0),
        ([0, 0, 0], 0),
    ],
    ids=[
        'whole',
        'gaps',
        'late start',
        'two publishers',
        'one of two has a gap',
        'a second publisher starts late',
        'unknown',
    ],
)
def test_lost_is_what_is_missing_between(sequences, lost):
    assert counted(sequences).lost == lost
    assert counted(sequences).received == len(sequences)


def test_random_loss_of_one_publisher_is_counted_exactly():
    chance = random.Random(1)
    kept = [number for number in range(1, 2001) if chance.random() > 0.2]
    assert counted(kept).lost == kept[-1] - kept[0] + 1 - len(kept)


@pytest.mark.parametrize('seed', range(20))
def test_loss_of_several_publishers_is_never_overstated(seed):
    """Each begins at another number and loses a tenth of what it sends."""
    chance = random.Random(seed)
    heard, sent, sequences = [0, 40, 900], [0, 0, 0], []
    last = [None, None, None]
    for _ in range(3000):
        who = chance.randrange(3)
        sent[who] += 1
        if last[who] is None or chance.random() > 0.1:
            first = heard[who] + sent[who]
            last[who] = first
            sequences.append(first)
    true = sum(last[who] - heard[who] for who in range(3)) - len(sequences)
    assert 0.8 * true <= counted(sequences).lost <= true


def test_a_hundred_publishers_that_start_at_different_numbers_lose_nothing():
    chance = random.Random(3)
    numbers = list(range(0, 2000, 20))
    sequences = []
    for _ in range(3000):
        who = chance.randrange(len(numbers))
        numbers[who] += 1
        sequences.append(numbers[who])
    assert counted(sequences).lost == 0


def test_the_rate_is_that_between_first_and_last():
    assert counted([1, 2, 3]).rate == pytest.approx(10.0)
    assert counted([1]).rate == 0.0


def test_the_text_counts_sent_messages():
    assert (
        lost_text({'/a': counted([1, 2, 5]), '/b': counted([1])}) == '2 of 6 messages lost: /a 2'
    )


def test_the_longest_gap_is_between_two_messages_however_the_poll_mixed_them_up():
    traffic = Traffic()
    for number, log_ns in enumerate([100, 300, 200, 350, 900], 1):
        traffic.add(number, log_ns)
    assert (traffic.longest_ns, traffic.first_ns, traffic.last_ns) == (550, 100, 900)
