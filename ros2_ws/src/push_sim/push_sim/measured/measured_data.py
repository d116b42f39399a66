"""A folder of measurements, and its split into a part to fit and a part to test."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce
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

SHORT_FILES = 'square_4mm_pushes*.csv'
LONG_FILES = 'square_50mm_pushes*.csv'
RUN_FILES = 'robot_runs/*.csv'


@dataclass(frozen=True)
class MeasuredData:
    """The measurements of a folder.

    Attributes:
        short: pushes of 4 mm from all matching files; None if there are none.
        long: straight pushes of 50 mm by file name.
        runs: runs of the real robot, by file name.
    """

    short: PushSet | None
    long: Mapping[str, LongPushes]
    runs: tuple[RobotRun, ...]

    @property
    def missing(self) -> tuple[str, ...]:
        """File patterns without a file."""
        parts = ((SHORT_FILES, self.short), (LONG_FILES, self.long), (RUN_FILES, self.runs))
        return tuple(pattern for pattern, part in parts if not part)


def files_hash(folder: Path) -> str:
    """SHA-256 of all measurement files of a folder, in the order of their names."""
    digest = hashlib.sha256()
    for pattern in (SHORT_FILES, LONG_FILES, RUN_FILES):
        for path in sorted(folder.glob(pattern)):
            digest.update(path.read_bytes())
    return digest.hexdigest()


def read_measured_data(folder: Path) -> MeasuredData:
    """Reads all measurement files of a folder.

    Raises:
        InputError: the folder does not exist or has no such file, or a file is faulty.
    """
    if not folder.is_dir():
        raise InputError(f'{folder} is no folder; name the one with the measured pushes')
    short = [read_pushes(path) for path in sorted(folder.glob(SHORT_FILES))]
    data = MeasuredData(
        reduce(PushSet.joined, short) if short else None,
        {path.name: read_long_pushes(path) for path in sorted(folder.glob(LONG_FILES))},
        tuple(read_robot_run(path) for path in sorted(folder.glob(RUN_FILES))),
    )
    if len(data.missing) == 3:
        raise InputError(f'{folder} holds none of {", ".join(data.missing)}')
    return data


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
