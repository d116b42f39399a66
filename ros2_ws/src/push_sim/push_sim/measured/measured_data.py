"""A folder of measurements: short pushes, long pushes, robot runs, as far as they are there."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce
from pathlib import Path

from push_core.common import InputError
from push_core.data import LongPushes, PushSet, read_long_pushes, read_pushes

from push_sim.measured.robot_run import RobotRun, read_robot_run

SHORT_FILES = 'square_4mm_pushes*.csv'
LONG_FILES = 'square_50mm_pushes*.csv'
RUN_FILES = 'robot_runs/*.csv'


@dataclass(frozen=True)
class MeasuredData:
    """What a folder holds.

    Attributes:
        short: pushes of 4 mm, of all files that match; None where there is none.
        long: straight pushes of 50 mm by the name of their file.
        runs: of the real cell.
    """

    short: PushSet | None
    long: Mapping[str, LongPushes]
    runs: tuple[RobotRun, ...]

    @property
    def missing(self) -> tuple[str, ...]:
        """Which kinds of files are not there."""
        parts = ((SHORT_FILES, self.short), (LONG_FILES, self.long), (RUN_FILES, self.runs))
        return tuple(pattern for pattern, part in parts if not part)


def files_hash(folder: Path) -> str:
    """SHA-256 over the files that are read, in the order of their names."""
    digest = hashlib.sha256()
    for pattern in (SHORT_FILES, LONG_FILES, RUN_FILES):
        for path in sorted(folder.glob(pattern)):
            digest.update(path.read_bytes())
    return digest.hexdigest()


def read_measured_data(folder: Path) -> MeasuredData:
    """Reads a folder of the form of the measured data.

    Raises:
        InputError: there is no such folder, nothing in it, or a file is faulty.
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
