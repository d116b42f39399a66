"""A folder of measurements, and its split into a part to fit and a part to test."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from push_core.common import InputError
from push_core.data import (
    LongPushes,
    PushSet,
    RobotRun,
    read_long_pushes,
    read_pushes,
    read_robot_run,
)

from push_sim.measured.measurement_files import (
    COLUMNS,
    LONG_PUSHES,
    ROBOT_RUNS,
    SHORT_PUSHES,
    measurement_files,
)


@dataclass(frozen=True)
class MeasuredData:
    """The measurements of a folder.

    Attributes:
        short: pushes of 4 mm of all files; None if there are none.
        long: straight pushes of 50 mm by file name.
        runs: runs of the real robot, by file name.
        left_out: files that hold none of these, with the reason.
    """

    short: PushSet | None
    long: Mapping[str, LongPushes]
    runs: tuple[RobotRun, ...]
    left_out: Mapping[str, str] = field(default_factory=dict)

    @property
    def missing(self) -> tuple[str, ...]:
        """Kinds of measurements without a file."""
        parts = ((SHORT_PUSHES, self.short), (LONG_PUSHES, self.long), (ROBOT_RUNS, self.runs))
        return tuple(kind for kind, part in parts if not part)


def read_measured_data(folder: Path) -> MeasuredData:
    """Reads all measurement files of a folder, whatever they are called.

    Raises:
        InputError: the folder does not exist or has no such file, or a file is faulty.
    """
    files = measurement_files(folder)
    short, long, runs = (files.of_kind[kind] for kind in (SHORT_PUSHES, LONG_PUSHES, ROBOT_RUNS))
    data = MeasuredData(
        _joined(short),
        {files.name(path): read_long_pushes(path) for path in long},
        tuple(read_robot_run(path) for path in runs),
        {files.name(path): reason for path, reason in files.left_out.items()},
    )
    if len(data.missing) == len(COLUMNS):
        why = ''.join(f'; {name} {reason}' for name, reason in list(data.left_out.items())[:3])
        raise InputError(f'{folder} holds none of {", ".join(data.missing)}{why}')
    return data


def _joined(paths: Sequence[Path]) -> PushSet | None:
    """The pushes of all files.

    Raises:
        InputError: a file is faulty, or its pushes are of another distance.
    """
    joined = None
    for path in paths:
        pushes = read_pushes(path)
        if joined and pushes.distance != joined.distance:
            raise InputError(
                f'{path}: pushes of {1e3 * pushes.distance:g} mm, but of '
                f'{1e3 * joined.distance:g} mm in {paths[0]}; put them into a folder of their own'
            )
        joined = joined.joined(pushes) if joined else pushes
    return joined


def split_measurements(data: MeasuredData, seed: int) -> tuple[MeasuredData, MeasuredData]:
    """Splits measurements into a part to fit and a part to test.

    The part to fit gets a random half of the short pushes and of each file of long pushes, and
    the last run by name (the unperturbed one of the measured set). A single run is in both parts.
    """
    random = np.random.default_rng(seed)
    short = _halves(random, len(data.short)) if data.short else None
    long = {file: _halves(random, len(pushes)) for file, pushes in data.long.items()}
    runs = data.runs[-1:], data.runs[:-1] or data.runs
    fit, test = (
        MeasuredData(
            data.short.take(short[part]) if data.short and short else None,
            {file: pushes.take(long[file][part]) for file, pushes in data.long.items()},
            runs[part],
        )
        for part in (0, 1)
    )
    return fit, test


def _halves(random: np.random.Generator, count: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    order = random.permutation(count)
    return np.sort(order[: count // 2]), np.sort(order[count // 2 :])
