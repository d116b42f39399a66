"""The main function of every node: start, spin, stop on SIGINT or SIGTERM, print an error."""

import atexit
import inspect
import os
import re
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from types import FrameType

import rclpy
from push_core.common import (
    INTERRUPTED,
    InputError,
    InterruptsHeld,
    PushError,
    describe,
    take_held_interrupt,
)
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.utilities import remove_ros_args

from push_node.parameter_yaml import load_yaml
from push_node.parameters import check_sim_time
from push_node.start_ros import init_ros

_LONGEST_WAIT = 0.1  # [s]
_HELP = """
A node of the cell. `ros2 run push_bringup cell` starts all nodes. It runs until Ctrl-C.

  --ros-args -p NAME:=VALUE        sets a parameter
  --ros-args --params-file FILE    sets many
  ros2 run push_bringup parameters lists them all, with units, defaults and ranges
"""
LAUNCHED = 'PUSH_LAUNCHED'
"""Environment variable that our launch file sets for its nodes."""

_stop_requested = False


def request_stop() -> None:
    """Ends the node of this process cleanly after the current callback."""
    global _stop_requested  # noqa: PLW0603
    _stop_requested = True


def run_node(make_node: Callable[[], Node], argv: Sequence[str] | None = None) -> int:
    """Runs one node until it is asked to stop.

    Args:
        make_node: makes the node; its `destroy_node` cleans up.
        argv: ROS arguments; default: those of the process.

    Returns:
        Exit status: 0 stopped on request, 1 the node failed, 2 an argument was wrong, 130
        interrupted before the node was made; a launch file gets 0 for that, too.
    """
    # held for the threads of the middleware too: OSQP's handler would take a Ctrl-C there
    with InterruptsHeld():
        return _run_node(make_node, sys.argv if argv is None else ['node', *argv])


def _run_node(make_node: Callable[[], Node], arguments: Sequence[str]) -> int:
    stop_on_signals()
    try:
        if _wants_help(arguments):
            print(f'{inspect.getdoc(make_node)}\n{_HELP}', end='')  # noqa: T201
            return 0
        if take_held_interrupt():
            return _interrupted()
        init_ros(arguments)
        node = _made(make_node)
        try:
            spinner = Spinner(node)
            while spinner.once():
                pass
        finally:
            node.destroy_node()
    except (PushError, OSError) as error:
        sys.stderr.write(f'{_name(make_node)}: {describe(error)}\n')
        return error.status if isinstance(error, PushError) else 1
    except KeyboardInterrupt:  # of a long step while the node was made
        return _interrupted()
    finally:
        rclpy.try_shutdown()
        # only then: processes started from here on would inherit it
        atexit.register(_ignore_signals)
    return 0


def _interrupted() -> int:
    # launch reports any other status than 0 as a crash
    return 0 if LAUNCHED in os.environ else INTERRUPTED


class Spinner:
    """Spins one node with the events executor, in steps so that signals are handled."""

    def __init__(self, node: Node) -> None:
        self._executor = EventsExecutor()
        self._executor.add_node(node)

    def once(self) -> bool:
        """Handles one event, or waits up to 0.1 s for one; False after a stop was requested."""
        if not _stop_is_requested():
            self._executor.spin_once(timeout_sec=_LONGEST_WAIT)
        return not _stop_is_requested()

    def close(self) -> None:
        """Lets go of the node, which else stays in the graph until the process ends."""
        self._executor.shutdown()


def _stop_is_requested() -> bool:
    if take_held_interrupt():
        request_stop()
    return _stop_requested


def stop_on_signals() -> None:
    """Makes SIGINT and SIGTERM request a stop instead of ending the process at once."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _on_signal)


def _ignore_signals() -> None:
    """Lets a further Ctrl-C not kill the interpreter, which resets handlers while it ends."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)


def _wants_help(arguments: Sequence[str]) -> bool:
    """Whether --help is given; a node has no other argument of its own."""
    with _ros_arguments():
        own = remove_ros_args(arguments)[1:]
    _check_clock(arguments)
    if own and own[0] not in ('-h', '--help'):
        raise InputError(f'unknown argument {own[0]!r}; parameters follow --ros-args, see --help')
    return bool(own)


def _check_clock(arguments: Sequence[str]) -> None:
    """Refuses a use_sim_time that rclpy would ignore with an error in its log."""
    for argument in arguments:
        name, separator, value = argument.partition(':=')
        if separator and name.rpartition(':')[2] == 'use_sim_time':
            check_sim_time(load_yaml(value))


@contextmanager
def _ros_arguments() -> Iterator[None]:
    try:
        yield
    except Exception as error:  # the exceptions of rclpy have no common base class
        raise InputError(f'bad ROS arguments: {error}') from error


def _made(make_node: Callable[[], Node]) -> Node:
    try:
        return make_node()
    except RuntimeError as error:
        if isinstance(error, PushError):
            raise
        raise InputError(f'cannot start: {error}') from error


def _name(make_node: Callable[[], Node]) -> str:
    """Name of the executable: GpServer is gp_server."""
    return re.sub(r'(?<=.)(?=[A-Z])', '_', getattr(make_node, '__name__', 'node')).lower()


def _on_signal(_number: int, _frame: FrameType | None) -> None:
    request_stop()
