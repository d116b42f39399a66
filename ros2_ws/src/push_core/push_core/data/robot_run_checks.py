"""Checks of a robot run: rows, units, and whether heading and positions belong to one push."""

import math

import numpy as np
from numpy.typing import NDArray

from push_core.common import InputError
from push_core.data.csv_table import CsvTable
from push_core.geometry import Array, points_to_body

SHORTEST = 1.0  # [s]
LONGEST_GAP = 0.2  # [s] between two rows
AT_REST = 1e-4  # [m] of the tip's last position
FARTHEST = 10.0  # [m] from the origin; a file in millimetres lies beyond
NEAREST = 0.5  # [m] from the tip to the object's centre, reached at least once in a push
FASTEST_ROWS = 1e-4  # [s] between two rows
TIMES = (('milliseconds', 1e3), ('microseconds', 1e6), ('nanoseconds', 1e9))
LENGTHS = (('centimetres', 1e2), ('millimetres', 1e3))
TOUCHING = (0.01, 0.2)  # [m] from the tip to the object's centre while it pushes
ODD_SPREAD = 1e-3  # [m] of the tip's distance from the face that only a wrong heading explains
DECISIVE = 5.0  # ratio of the spreads as given and with a mistake undone


def check_rows(table: CsvTable) -> None:
    """Checks the rows one by one.

    Raises:
        InputError: one line that names the file, the line and the fault.
    """
    time = table.columns['t_s']
    if len(time) < 2:
        raise InputError(f'{table.place(0)}: is the only row of the run')
    steps = np.diff(time, prepend=-np.inf)
    _refuse(table, steps <= 0.0, 't_s does not rise')
    _check_time_unit(table, float(np.median(steps[1:])))
    gaps = (steps > LONGEST_GAP) & np.isfinite(steps)
    _refuse(table, gaps, f'more than {LONGEST_GAP:g} s are missing')
    lengths = np.abs([values for name, values in table.columns.items() if name.endswith('_m')])
    _refuse(
        table,
        np.asarray((lengths > FARTHEST).any(axis=0)),
        f'a position is beyond {FARTHEST:g} m; metres are expected',
    )
    _refuse(
        table,
        np.abs(table.columns['slider_theta_rad']) > math.tau,
        'slider_theta_rad is beyond 2 pi; radians are expected',
    )


def check_run(place: str, time: Array, pose: Array, tip: Array) -> None:
    """Checks a run as a whole.

    Args:
        place: name of the file, for the messages.
        time: (n,) since the first row [s].
        pose: (n, 3) of the object.
        tip: (n, 2) position of the tip.

    Raises:
        InputError: one line that names the fault.
    """
    if time[-1] < SHORTEST:
        raise InputError(f'{place}: the run lasts less than {SHORTEST:g} s')
    if (np.linalg.norm(tip - tip[-1], axis=1) <= AT_REST).all():
        raise InputError(f'{place}: the tip does not move in the whole run')
    nearest = float(np.linalg.norm(tip - pose[:, :2], axis=1).min())
    if nearest > NEAREST:
        units = [f', as in {unit}' for unit, factor in LENGTHS if _touches(nearest / factor)]
        raise InputError(
            f"{place}: the tip is never closer than {nearest:.3g} m to the object's centre"
            f'{"".join(units)}; metres are expected'
        )
    _check_heading(place, pose, tip)


def _refuse(table: CsvTable, wrong: NDArray[np.bool_], text: str) -> None:
    if wrong.any():
        raise InputError(f'{table.place(int(np.argmax(wrong)))}: {text}')


def _check_time_unit(table: CsvTable, step: float) -> None:
    if step <= LONGEST_GAP:
        return
    likely = [unit for unit, factor in TIMES if FASTEST_ROWS <= step / factor <= LONGEST_GAP]
    hint = f', as in {likely[0]}' if likely else ''
    raise InputError(
        f'{table.place(1)}: t_s rises by {step:g} from row to row{hint}; seconds are expected'
    )


def _touches(distance: float) -> bool:
    return TOUCHING[0] <= distance <= TOUCHING[1]


def _check_heading(place: str, pose: Array, tip: Array) -> None:
    """Checks that the tip stays on one face.

    A heading in degrees or of the other sense turns the face away from the tip.
    """
    given, _ = _spread(pose, tip, 1.0)
    for factor, text in (
        (math.radians(1.0), 'looks like degrees; radians are expected'),
        (-1.0, 'has the other sense; it grows anticlockwise'),
    ):
        spread, is_behind = _spread(pose, tip, factor)
        if is_behind and given > ODD_SPREAD and spread < given / DECISIVE:
            raise InputError(f'{place}: slider_theta_rad {text}')


def _spread(pose: Array, tip: Array, factor: float) -> tuple[float, bool]:
    """The tip at the face, with the headings times a factor.

    Returns:
        Spread [m] of its distance from the face, and whether it is behind that face at all.
    """
    turned = np.column_stack([pose[:, :2], factor * pose[:, 2]])
    x, y = points_to_body(turned, tip).T
    low, high = np.percentile(x, [5.0, 95.0])
    return float(high - low), bool(np.median(x) < -abs(np.median(y)))
