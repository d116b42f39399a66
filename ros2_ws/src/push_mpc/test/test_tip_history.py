"""The pose of the tip nearest to a time, among the last ones."""

from hypothesis import given
from hypothesis import strategies as st
from push_mpc.estimate import TipHistory

MILLISECOND = 1_000_000
STAMPS = st.lists(st.integers(0, 10**9), min_size=1, max_size=200, unique=True)


def filled(stamps: list[int]) -> TipHistory[int]:
    history: TipHistory[int] = TipHistory()
    for stamp in stamps:
        history.add(stamp, -stamp)
    return history


@given(STAMPS, st.integers(-(10**8), 2 * 10**9))
def test_it_is_the_nearest_of_the_last_64_whatever_the_rates(stamps, wanted) -> None:
    ordered = sorted(stamps)
    stamp, pose = filled(ordered).nearest(wanted)
    assert pose == -stamp
    assert abs(stamp - wanted) == min(abs(each - wanted) for each in ordered[-64:])


def test_an_exposure_that_comes_late_finds_the_tip_of_its_own_time() -> None:
    history = filled(list(range(0, 200 * MILLISECOND, 4 * MILLISECOND)))
    # cameras with 33 ms between exposures and 60 ms of latency
    assert history.nearest(131 * MILLISECOND)[0] == 132 * MILLISECOND
    assert history.nearest(98 * MILLISECOND)[0] == 100 * MILLISECOND


def test_a_stamp_that_goes_back_or_repeats_forgets_what_was_before() -> None:
    history = filled([10, 20, 30])
    history.add(5, -5)
    assert history.nearest(30) == (5, -5)
    history.add(5, 7)
    assert history.nearest(5) == (5, 7)


def test_of_none_there_is_no_nearest() -> None:
    history = filled([1])
    history.clear()
    assert history.nearest(1) is None
