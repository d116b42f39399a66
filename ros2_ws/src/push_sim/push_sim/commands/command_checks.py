"""What the commands check of their options and data."""

import sys
from pathlib import Path

from push_core.common import InputError

from push_sim.measured import MeasuredData, read_measured_data

_MOST_JOBS = 256


def check_range(name: str, value: int, low: int, high: int) -> None:
    """Checks a whole number.

    Raises:
        InputError: it is out of range.
    """
    if not low <= value <= high:
        raise InputError(f'{name} is {value}, must be between {low} and {high}')


def check_jobs(jobs: int) -> None:
    """Checks a number of processes; raises `InputError`."""
    check_range('--jobs', jobs, 1, _MOST_JOBS)


def check_seed(seed: int) -> None:
    """Checks the seed of a random generator; raises `InputError`."""
    check_range('--seed', seed, 0, 2**62)


def read_and_tell(folder: Path, command: str) -> MeasuredData:
    """The measurements of a folder; tells on standard error which files were left out.

    Raises:
        InputError: the folder has no measurements, or a file is faulty.
    """
    data = read_measured_data(folder)
    for name, reason in data.left_out.items():
        sys.stderr.write(f'{command}: left out {name}: {reason}\n')
    return data
