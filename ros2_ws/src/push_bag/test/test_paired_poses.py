"""Poses of object and tip that were measured at times and rates of their own."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from push_bag.run import PAIRED, ByStamp, Stamped

STAMPS = st.lists(st.integers(0, 10**9), min_size=1, max_size=60, unique=True)
MILLISECOND = 1_000_000


@given(STAMPS, STAMPS)
def test_the_nearest_message_is_found_and_told_from_one_too_far(own, asked) -> None:
    stamps, wanted = np.sort(np.array(own)), np.array(asked)
    rows = Stamped(stamps, stamps, np.zeros((stamps.size, 1)))
    index, near = rows.near(wanted)
    apart = np.abs(wanted[:, None] - stamps[None, :]).min(axis=1)
    np.testing.assert_array_equal(np.abs(stamps[index] - wanted), apart)
    np.testing.assert_array_equal(near, apart <= PAIRED)


def test_without_messages_none_is_near() -> None:
    nothing = Stamped(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 2)))
    assert not nothing.near(np.array([1, 2]))[1].any()


def test_what_was_published_later_was_not_seen() -> None:
    stamps = [4 * MILLISECOND * number for number in range(10)]
    published = [stamp + MILLISECOND for stamp in stamps]
    rows = ByStamp(stamps, published)
    exposure = 19 * MILLISECOND
    assert rows.row(exposure, 30 * MILLISECOND, PAIRED) == 5
    assert rows.row(exposure, 20 * MILLISECOND, PAIRED) == 4
    assert rows.row(exposure, 30 * MILLISECOND) is None
    assert rows.row(exposure, 5 * MILLISECOND, PAIRED) is None
    # of two as near the later, as the controller takes it
    assert rows.row(18 * MILLISECOND, 30 * MILLISECOND, PAIRED) == 5
