"""Counts, rates and gaps in the order of log times, and what sequence numbers tell."""

import random

import pytest
from push_bag.commands.info import main as info
from push_bag.file.reader import BagReader
from push_bag.file.traffic import TrafficLog, counted, lost_text
from push_bag.repair.recover import recover
from push_bag.replay.playback import in_order
from push_bag.replay.survey import survey
from push_bag.run.run_reader import read_run

PERIOD = 10_000_000


def shuffled(count):
    chance = random.Random(2)
    numbers = list(range(count))
    chance.shuffle(numbers)
    return numbers


ORDERS = {
    'sorted': list(range(200)),
    'reversed': list(range(200))[::-1],
    'jitter': sorted(range(200), key=lambda n: n + random.Random(n).uniform(0, 12)),
    'two files after one another': [*range(100, 200), *range(100)],
    'any': shuffled(200),
}


@pytest.fixture(params=ORDERS)
def disordered(request, bag):
    """A file with every message of one publisher in some order."""
    with bag(chunk_size=500) as writing:
        channel = writing.channel()
        for number in ORDERS[request.param]:
            writing.add(channel, number * PERIOD, sequence=number + 1)
    return writing.path


def test_nothing_is_lost_whatever_the_order_in_the_file(disordered, capsys):
    assert info([str(disordered)]) == 0
    out = capsys.readouterr().out
    assert ': 1.99 s, finished' in out
    (row,) = (line.split() for line in out.splitlines() if line.startswith('/chatter'))
    assert row[2:] == ['200', '0', '100.0', '10.0']
    assert '0 of 200 messages lost' in out


def test_recover_misses_nothing_whatever_the_order(disordered, tmp_path):
    found = recover(disordered, tmp_path / 'saved')
    assert (found.messages, found.missing, found.missing_ns) == (200, 0, 0)


def test_replay_sorts_whatever_the_order(disordered):
    bag_survey = survey(disordered, None)
    records = in_order(BagReader(disordered).records(), bag_survey.disorder_ns)
    assert [each.log_ns for each in records] == [number * PERIOD for number in range(200)]


def test_the_score_counts_in_the_order_of_log_times(disordered):
    seen = read_run(disordered).traffic['/chatter']
    assert (seen.received, seen.lost, seen.longest_ns) == (200, 0, PERIOD)


def log(numbers, times=None):
    messages = TrafficLog()
    for row, number in enumerate(numbers):
        messages.add(number, times[row] if times else row * PERIOD)
    return messages


@pytest.mark.parametrize(
    ('numbers', 'lost'),
    [
        ([0, 1, 2, 3], 0),
        ([0, 2, 3], 1),
        ([4, 2, 1, 3], 0),
        ([9, 1, 8, 2, 7], 4),
        ([1, 2, 3, 1, 2, 3], 0),
        ([7], 0),
        ([1, 1, 1], 0),
        ([4294967295, 1, 2], 0),
    ],
    ids=[
        'from 0',
        'from 0 with a loss',
        'mixed up',
        'gaps mixed up',
        'restart',
        'one',
        'three publishers',
        'wrapped',
    ],
)
def test_numbers_tell_what_is_lost(numbers, lost):
    seen = log(numbers).traffic()
    assert (seen.lost_is_known, seen.lost) == (True, lost)


@pytest.mark.parametrize('numbers', [[0, 0, 0], [0], [1] * 20, [5] * 200])
def test_equal_numbers_tell_nothing(numbers):
    seen = log(numbers).traffic()
    assert not seen.lost_is_known
    assert 'is not known' in lost_text({'/a': seen})


def test_messages_of_equal_time_are_in_the_order_of_their_numbers():
    assert log([3, 1, 2, 5, 4], [7, 7, 7, 7, 7]).traffic().lost == 0


def test_one_counter_over_all_topics_loses_nothing():
    traffic = counted({'/a': log([1, 3, 5, 7]), '/b': log([2, 4, 6, 8])})
    assert [each.lost for each in traffic.values()] == [0, 0]
    assert lost_text(traffic) == '0 of 8 messages lost'


def test_one_counter_with_a_gap_does_not_tell_which_topic_lost_it():
    traffic = counted({'/a': log([1, 3, 5, 9]), '/b': log([2, 4, 6, 10])})
    assert 'is not known' in lost_text(traffic)


def test_the_sum_says_of_which_topics_it_is_not_known():
    traffic = counted({'/a': log([1, 2, 5]), '/b': log([0, 0])})
    assert lost_text(traffic) == (
        '2 of 5 messages lost: /a 2; not known of 2 without sequence numbers: /b'
    )


def test_a_bag_without_numbers_does_not_say_that_nothing_is_lost(bag, capsys):
    with bag() as writing:
        channel = writing.channel()
        for number in range(40):
            writing.add(channel, number * PERIOD)
    assert info([str(writing.path)]) == 0
    assert '40 messages; how many were lost is not known' in capsys.readouterr().out
