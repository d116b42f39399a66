"""The way between two machines and the offset of their clocks, from measurements with jitter."""

import numpy as np
import pytest
from push_mpc.estimate import LinkEstimate


def estimated(way: float, offset: float, jitter: float = 0.0, count: int = 16) -> LinkEstimate:
    """Measurements over a way [s], up to `jitter` longer, with a clock that is behind."""
    random, estimate = np.random.default_rng(2), LinkEstimate()
    for _ in range(count):
        there, back, alone = way + jitter * random.uniform(0.0, 1.0, 3)
        estimate.add_round_trip(there + back)
        estimate.add_age(alone + offset)
    return estimate


@pytest.mark.parametrize('offset', [0.0, 0.02, -0.02, 5.0])
def test_an_even_way_tells_both_exactly(offset: float) -> None:
    estimate = estimated(0.003, offset)
    assert estimate.way == pytest.approx(0.003)
    assert estimate.offset == pytest.approx(offset)


def test_a_slow_link_with_equal_clocks_is_no_fault() -> None:
    estimate = estimated(0.003, 0.0, jitter=0.004)
    assert estimate.way == pytest.approx(0.0035, abs=0.001)
    assert estimate.fault(0.005) == ''


def test_a_clock_that_is_off_is_told_with_its_direction() -> None:
    assert estimated(0.003, 0.02).fault(0.005) == '20 ms behind (the way takes 3.0 ms)'
    assert estimated(0.003, -0.02).fault(0.005) == '20 ms ahead (the way takes 3.0 ms)'


def test_an_offset_that_the_way_may_hide_is_no_fault() -> None:
    assert estimated(0.010, 0.014).fault(0.005) == ''
    assert estimated(0.001, 0.014).fault(0.005) != ''


def test_after_few_measurements_nothing_is_known() -> None:
    estimate = estimated(0.003, 0.5, count=4)
    assert (estimate.way, estimate.offset, estimate.fault(0.005)) == (0.0, 0.0, '')


def test_an_old_clock_is_forgotten_after_sixteen_measurements() -> None:
    estimate = estimated(0.003, -0.5)
    for _ in range(16):
        estimate.add_age(0.003)
    assert estimate.offset == pytest.approx(0.0)
