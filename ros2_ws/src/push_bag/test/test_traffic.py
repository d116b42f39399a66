"""Gaps are counted from sequence numbers, also where publishers share a topic."""

import pytest
from push_bag.traffic import Traffic, lost_text


def counted(sequences):
    traffic = Traffic()
    for number, sequence in enumerate(sequences):
        traffic.saw(sequence, (number + 1) * 100_000_000)
    return traffic


@pytest.mark.parametrize(
    ('sequences', 'lost'),
    [
        ([1, 2, 3], 0),
        ([1, 2, 5, 6, 8], 3),
        ([7, 8, 10], 1),
        ([1, 1, 2, 3, 2, 3, 4], 0),
        ([1, 2, 3, 1, 2, 5, 3, 4], 1),
        ([0, 0, 0], 0),
    ],
    ids=['whole', 'gaps', 'late start', 'two publishers', 'one of two has a gap', 'unknown'],
)
def test_lost_is_what_is_missing_between(sequences, lost):
    assert counted(sequences).lost == lost
    assert counted(sequences).received == len(sequences)


def test_the_rate_is_that_between_first_and_last():
    assert counted([1, 2, 3]).rate == pytest.approx(10.0)
    assert counted([1]).rate == 0.0


def test_the_text_counts_sent_messages():
    assert lost_text({'/a': counted([1, 2, 5]), '/b': counted([1])}) == '2 of 6 messages lost'
