"""The main of every node: start, spin, stop on SIGINT or SIGTERM, one line for an error."""

import signal
import sys
from collections.abc import Callable, Sequence
from types import FrameType

import rclpy
from push_core.command_line import describe
from push_core.errors import InputError, PushError
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

_LONGEST_WAIT = 0.1  # [s]
_stop_requested = False


def request_stop() -> None:
    """Lets the node of this process end cleanly after the current callback."""
    global _stop_requested  # noqa: PLW0603
    _stop_requested = True


def run_node(make_node: Callable[[], Node], argv: Sequence[str] | None = None) -> int:
    """Runs one node until it is asked to stop.

    Args:
        make_node: builds the node; its `destroy_node` does the clean-up.
        argv: ROS arguments; default: those of the process.

    Returns:
        Exit status: 0 stopped on request, 1 the node failed, 2 a parameter was wrong.
    """
    stop_on_signals()
    try:
        _init(argv)
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
    finally:
        rclpy.try_shutdown()
    return 0


class Spinner:
    """Spins one node, in the only way in which this executor heeds signals and spares the core."""

    def __init__(self, node: Node) -> None:
        self._executor = EventsExecutor()
        self._executor.add_node(node)

    def once(self) -> bool:
        """Handles one event, or waits a moment for one; False once a stop was requested."""
        if not _stop_requested:
            self._executor.spin_once(timeout_sec=_LONGEST_WAIT)
        return not _stop_requested


def stop_on_signals() -> None:
    """Lets SIGINT and SIGTERM request a stop instead of ending the process at once."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _on_signal)


def _init(argv: Sequence[str] | None) -> None:
    arguments = sys.argv if argv is None else ['node', *argv]
    try:
        rclpy.init(args=arguments, signal_handler_options=SignalHandlerOptions.NO)
    except Exception as error:  # rclpy's own kinds share no base class
        raise InputError(f'bad ROS arguments: {error}') from error


def _made(make_node: Callable[[], Node]) -> Node:
    try:
        return make_node()
    except RuntimeError as error:
        if isinstance(error, PushError):
            raise
        raise InputError(f'cannot start: {error}') from error


def _name(make_node: Callable[[], Node]) -> str:
    return getattr(make_node, '__name__', 'node')


def _on_signal(_number: int, _frame: FrameType | None) -> None:
    request_stop()
