"""A lap is completed when it arrives, near the reference and with the tip on the face."""

import math

import pytest
from push_core.tracks.completion import END_DISTANCE, END_GAP, is_completed

GOOD = {
    'arrived': True,
    'distance': END_DISTANCE,
    'gap': END_GAP,
    'contact_offset': -0.045,
    'side': 0.09,
}


def test_a_lap_that_ends_on_every_bound_is_completed():
    assert is_completed(**GOOD)


@pytest.mark.parametrize(
    'spoilt',
    [
        {'arrived': False},
        {'distance': 0.0501},
        {'gap': 0.00101},
        {'gap': math.nan},
        {'contact_offset': 0.0451},
        {'contact_offset': -0.0451},
    ],
)
def test_one_bound_that_is_exceeded_makes_it_incomplete(spoilt):
    assert not is_completed(**{**GOOD, **spoilt})
