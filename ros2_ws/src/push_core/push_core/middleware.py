"""Whether the ROS middleware that RMW_IMPLEMENTATION names is installed.

The import of rclpy ends the process where it is not, even in a command that sends nothing. So the
console scripts take the variable away then, and what needs the middleware says so.
"""

import os
from pathlib import Path

VARIABLE = 'RMW_IMPLEMENTATION'
_INDEX = 'share/ament_index/resource_index/rmw_typesupport'
_FACADE = 'rmw_implementation'
_missing = ''


def set_missing_middleware_aside() -> None:
    """Removes the variable if it names a middleware that is not installed."""
    global _missing  # noqa: PLW0603
    name, installed = os.environ.get(VARIABLE, ''), installed_middleware()
    if name and installed and name not in installed:
        _missing = name
        del os.environ[VARIABLE]


def missing_middleware() -> str:
    """The name that was set aside, else an empty string."""
    return _missing


def installed_middleware() -> list[str]:
    """The names of all that are installed."""
    folders = [
        Path(prefix) / _INDEX for prefix in os.environ.get('AMENT_PREFIX_PATH', '').split(':')
    ]
    names = {path.name for folder in folders if folder.is_dir() for path in folder.iterdir()}
    return sorted(names - {_FACADE})
