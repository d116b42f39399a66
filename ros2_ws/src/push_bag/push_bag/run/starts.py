"""Finds the starts in a bag: each begins when a controller that stood still is armed.

A bag that is recorded by hand may hold several starts, of one controller, of one that was started
again, or of two that ran at once and count their ticks apart.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from push_msgs.msg import ControllerState

from push_bag.run.series import NEVER, Nanoseconds

RUNNING = (
    ControllerState.ARMED,
    ControllerState.TRACKING,
    ControllerState.HOLDING,
    ControllerState.RECONTACT,
    ControllerState.STOPPING,
)
RETIRED = 200  # ticks of others after which a controller is taken to have ended

Rows = NDArray[np.intp]


@dataclass(frozen=True)
class Start:
    """One start of a controller, from the first armed tick on.

    Attributes:
        ticks: (n,) rows of its ticks, up to the last one in DONE or STOPPED.
        own: (m,) rows of all ticks of its controller in the bag.
        ran: log times of the first and last tick before DONE or STOPPED [ns].
        begin: log time at which its messages begin [ns].
        end: log time before which they end [ns].
    """

    ticks: Rows
    own: Rows
    ran: tuple[int, int]
    begin: int
    end: int


def find_starts(
    logged: Nanoseconds,
    mode: NDArray[np.int64],
    tick: NDArray[np.int64],
    resets: Nanoseconds,
) -> list[Start]:
    """The starts in order of time.

    Args:
        logged: (n,) log times of the controller's ticks [ns], in order.
        mode: (n,) of each tick.
        tick: (n,) the controller's count of its ticks.
        resets: log times at which the stamps of the plant went back [ns], see `find_resets`.
    """
    whose = controllers(tick)
    every = [np.flatnonzero(whose == each) for each in range(int(whose.max(initial=-1)) + 1)]
    found = [(ran, ticks, own) for own in every for ran, ticks in _runs(own, mode)]
    found.sort(key=lambda each: int(each[0][0]))
    ran = [(int(logged[rows[0]]), int(logged[rows[-1]])) for rows, _, _ in found]
    begins = [_begin(number, ran, resets) for number in range(len(ran))]
    return [
        Start(
            ticks=ticks,
            own=own,
            ran=(first, last),
            begin=begin,
            end=min(
                next((each for each in begins if each > last), NEVER),
                next((int(each) for each in resets if each > first), NEVER),
            ),
        )
        for (_, ticks, own), (first, last), begin in zip(found, ran, begins, strict=True)
    ]


def _begin(number: int, ran: list[tuple[int, int]], resets: Nanoseconds) -> int:
    """Log time at which the messages of a start begin [ns].

    The plant repeats its stamps after a reset, so those before the last one are not of the start.
    """
    first = ran[number][0]
    before = max((last for _, last in ran[:number] if last < first), default=0)
    reset = [int(each) for each in resets if before < each <= first]
    return reset[-1] if reset else first if number else 0


def find_resets(logged: Nanoseconds, stamp: Nanoseconds) -> Nanoseconds:
    """Log times [ns] at which stamps (n,) [ns] began anew; not where two messages changed order.

    Args:
        logged: (n,) log times of the poses [ns], in order.
        stamp: (n,) of the poses [ns].
    """
    back = np.flatnonzero(stamp[1:] < stamp[:-1]) + 1
    following = stamp[np.minimum(back + 1, stamp.size - 1)]
    return logged[back[following < stamp[back - 1]]]


def controllers(tick: NDArray[np.int64]) -> Rows:
    """The number of the controller that each tick (n,) is of, by their counts of ticks."""
    whose = np.zeros(tick.size, np.intp)
    if np.all(np.diff(tick) > 0) or not tick.any():
        return whose
    newest: list[tuple[int, int]] = []  # count and row of the newest tick of each controller
    for row, count in enumerate(tick.tolist()):
        before = [
            (latest, at, number)
            for number, (latest, at) in enumerate(newest)
            if latest < count and row - at <= RETIRED
        ]
        number = max(before)[2] if before else len(newest)
        newest[number : number + 1] = [(count, row)]
        whose[row] = number
    return whose


def _runs(own: Rows, mode: NDArray[np.int64]) -> list[tuple[Rows, Rows]]:
    """Rows in which a controller ran, and these with its outcome, for each of its starts."""
    modes = mode[own]
    running = np.isin(modes, RUNNING)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], running, [False]]).astype(np.int8)))
    pairs = edges.reshape(-1, 2).tolist()
    return [(own[first:after], own[first : _last_of(modes, after)]) for first, after in pairs]


def _last_of(modes: NDArray[np.int64], row: int) -> int:
    """Where the block of equal modes ends that begins at a row."""
    others = np.flatnonzero(modes[row:] != modes[row]) if row < modes.size else np.zeros(0)
    return row + int(others[0]) if others.size else modes.size
