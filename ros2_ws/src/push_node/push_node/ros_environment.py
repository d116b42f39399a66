"""What the environment has to provide for ROS; errors say what to do. Imports no ROS."""

import os
from pathlib import Path

from push_core.common import InputError
from push_core.middleware import installed_middleware, missing_middleware

_HIGHEST_DOMAIN = 232  # DDS has no ports for more


def check_ros_environment() -> None:
    """Checks what starting a node needs.

    Raises:
        InputError: names the variable to set.
    """
    check_middleware()
    check_log_folder()


def check_log_folder() -> None:
    """Checks that ROS has a folder for its logs.

    Raises:
        InputError: it cannot be written; names the variable to set.
    """
    folder = _log_folder()
    if folder is None or not _is_usable(folder):
        where = f'{folder} cannot be written' if folder else 'HOME is not set'
        raise InputError(
            f'no place for the logs of ROS, {where}: set ROS_LOG_DIR to a folder that can be '
            'written'
        )


def check_middleware() -> None:
    """Checks the choice of middleware and domain.

    Raises:
        InputError: the middleware is not installed, or there is no such domain.
    """
    if missing_middleware():
        raise InputError(
            f'RMW_IMPLEMENTATION is {missing_middleware()}, which is not installed: install it, '
            f'or unset the variable; installed: {", ".join(installed_middleware())}'
        )
    domain = os.environ.get('ROS_DOMAIN_ID', '')
    if domain and not (domain.isdecimal() and int(domain) <= _HIGHEST_DOMAIN):
        raise InputError(
            f'ROS_DOMAIN_ID is {domain!r}, must be a whole number from 0 to {_HIGHEST_DOMAIN}'
        )


def _log_folder() -> Path | None:
    """Where ROS writes its logs, see rcl_logging; None without a home."""
    for variable, below in (('ROS_LOG_DIR', ''), ('ROS_HOME', 'log'), ('HOME', '.ros/log')):
        if os.environ.get(variable):
            return Path(os.environ[variable]).expanduser() / below
    return None


def _is_usable(folder: Path) -> bool:
    """Whether files can be written there, if need be by making the folder first."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    return os.access(folder, os.W_OK)
