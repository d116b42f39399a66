"""What the commands of the plant refuse before they begin."""

from push_core.common import InputError

MOST_JOBS = 256


def check_range(name: str, value: int, low: int, high: int) -> None:
    """Refuses a whole number out of its range.

    Raises:
        InputError: names the option, the value and the range.
    """
    if not low <= value <= high:
        raise InputError(f'{name} is {value}, must be between {low} and {high}')


def check_jobs(jobs: int) -> None:
    """Refuses a number of processes that cannot be."""
    check_range('--jobs', jobs, 1, MOST_JOBS)


def check_seed(seed: int) -> None:
    """Refuses a seed that no generator takes."""
    check_range('--seed', seed, 0, 2**62)
