"""Initialises ROS in this process."""

from collections.abc import Sequence

import rclpy
from push_core.common import InputError
from rclpy.signals import SignalHandlerOptions

from push_node.ros_environment import check_log_folder, check_middleware


def init_ros(arguments: Sequence[str] | None = None) -> None:
    """Initialises rclpy, without handlers of its own for signals.

    Args:
        arguments: ROS arguments; default: none.

    Raises:
        InputError: says what of the environment or of the arguments to change.
    """
    given = arguments or []
    check_middleware()
    if '--disable-external-lib-logs' not in given:
        check_log_folder()
    try:
        rclpy.init(args=given, signal_handler_options=SignalHandlerOptions.NO)
    except Exception as error:  # the exceptions of rclpy have no common base class
        raise InputError(f'bad ROS arguments: {error}') from error
