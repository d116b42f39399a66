"""`ros2 run push_bringup start`: puts the object at the start of the plan and starts a run.

Where `start_from` of mpc_node is `here` the object stays, and the plan begins where it lies.
"""

import sys
import time
from collections.abc import Callable, Sequence

import rclpy
from push_core.common import InputError, RunError, describe
from push_node.spin import Spinner, stop_on_signals
from push_node.start_ros import init_ros
from rclpy.node import Node

from push_bringup.graph.starter import Starter


def main(argv: Sequence[str] | None = None) -> int:
    """Starts the cell in the namespace of the ROS arguments.

    Returns:
        Exit status: 0 started, or stopped by a signal; 1 the cell did not become ready; 2 an
        argument or the environment is wrong.
    """
    stop_on_signals()
    arguments = sys.argv if argv is None else ['start', *argv]
    try:
        init_ros(arguments)
        return _started(Node('start'))
    except InputError as error:
        sys.stderr.write(f'start: {error}\n')
        return error.status
    finally:
        rclpy.try_shutdown()


def _started(node: Node) -> int:
    spinner = Spinner(node)

    def wait(finished: Callable[[], bool], timeout: float) -> bool:
        deadline = time.monotonic() + timeout
        while not finished() and time.monotonic() < deadline:
            if not spinner.once():
                raise KeyboardInterrupt
        return finished()

    try:
        Starter(node, wait).start()
    except RunError as error:
        sys.stderr.write(f'start: {describe(error)}\n')
        return 1
    except KeyboardInterrupt:
        return 0
    sys.stdout.write('started\n')
    return 0


if __name__ == '__main__':
    sys.exit(main())
