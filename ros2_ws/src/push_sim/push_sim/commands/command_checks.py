"""Range checks of command line options."""

from push_core.common import InputError

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
