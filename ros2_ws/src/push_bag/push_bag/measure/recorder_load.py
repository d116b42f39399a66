"""A recorder in a process of its own, and a publisher that knows what it sent: for measuring."""

import signal
import subprocess
import sys
import time
from array import array
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any

import rclpy
from geometry_msgs.msg import TransformStamped
from push_core.common import RunError
from push_msgs.msg import Horizon
from push_node.cell_topics import CELL_TOPICS
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import ByteMultiArray
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from push_bag.file import message_class

READY_TIMEOUT = 30.0  # [s]
ARRIVAL_TIMEOUT = 5.0  # [s]
TICKS_PER_SECOND = 100.0  # of the kernel's accounting
LOAD = QoSProfile(depth=100)
TICK_TOPICS = ('object_pose', 'pusher_pose', 'pusher_velocity_cmd', 'controller_state', '/tf')
SLOW_TOPICS = ('horizon', 'scene')
SLOW_TICKS = 5
HORIZON = array('d', range(36))
# those whose size is not that of an empty message
FILLED = {
    'horizon': Horizon(x=HORIZON, y=HORIZON, theta=HORIZON),
    'scene': MarkerArray(markers=[Marker(), Marker()]),
    '/tf': TFMessage(transforms=[TransformStamped(), TransformStamped()]),
}


class RecorderProcess:
    """The recorder node as a child process; ends with the block."""

    def __init__(self, folder: Path, *parameters: str) -> None:
        """Starts it.

        Args:
            folder: of the run; must not exist yet.
            parameters: further ones, NAME:=VALUE.
        """
        words = [word for each in (f'folder:={folder}', *parameters) for word in ('-p', each)]
        command = [sys.executable, '-m', 'push_bag.record.recorder', '--ros-args', *words]
        self._process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)

    def __enter__(self) -> 'RecorderProcess':
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.kill()

    def kill(self) -> None:
        """Ends it at once, as if the power had failed."""
        self._process.kill()
        self._process.wait()
        if self._process.stderr is not None:
            self._process.stderr.close()

    def stop(self) -> str:
        """Asks it to end; gives its last words."""
        self._process.send_signal(signal.SIGINT)
        return self._process.communicate(timeout=READY_TIMEOUT)[1].strip()

    @property
    def processor_time(self) -> float:
        """Processor time [s] that it took so far."""
        fields = Path(f'/proc/{self._process.pid}/stat').read_text().rpartition(')')[2].split()
        return (int(fields[11]) + int(fields[12])) / TICKS_PER_SECOND

    @property
    def memory(self) -> float:
        """Memory [MB] that it holds."""
        status = Path(f'/proc/{self._process.pid}/status').read_text()
        return int(status.split('VmRSS:')[1].split()[0]) / 1024.0


class Publisher:
    """Publishes the topics of a cell, and one of raw bytes."""

    def __init__(self, node: Node) -> None:
        self._outlets: dict[str, Any] = {
            topic.name: node.create_publisher(
                message_class(topic.type_name), topic.name, topic.qos
            )
            for topic in CELL_TOPICS
            if topic.core or topic.name in FILLED
        }
        self._outlets['load'] = node.create_publisher(
            ByteMultiArray, 'load', QoSProfile(depth=100)
        )
        self._payload = ByteMultiArray(data=[bytes([each % 256]) for each in range(1000)])
        self.sent = dict.fromkeys(self._outlets, 0)
        self.sent_at: dict[str, list[int]] = {name: [] for name in self._outlets}

    def wait(self) -> None:
        """Waits until somebody hears every topic.

        Raises:
            RunError: nobody does.
        """
        end = time.monotonic() + READY_TIMEOUT
        while not all(each.get_subscription_count() for each in self._outlets.values()):
            if time.monotonic() > end:
                raise RunError('the recorder does not hear every topic')
            time.sleep(0.02)

    def tick(self, number: int) -> None:
        """What a cell publishes in one tick."""
        for name in TICK_TOPICS + (SLOW_TOPICS if number % SLOW_TICKS == 0 else ()):
            self.send(name, FILLED.get(name) or self._outlets[name].msg_type())

    def load(self, _number: int) -> None:
        """One message of 1 KB."""
        self.send('load', self._payload)

    def wait_until_heard(self) -> None:
        """Waits until everything that was sent is lost or has come; else its end would be cut."""
        for each in self._outlets.values():
            each.wait_for_all_acked(Duration(seconds=ARRIVAL_TIMEOUT))

    def send(self, name: str, message: Any) -> None:
        """Publishes one message and counts it."""
        self._outlets[name].publish(message)
        self.sent[name] += 1
        self.sent_at[name].append(time.time_ns())


def at_rate(work: Callable[[int], None], rate: float, seconds: float) -> float:
    """Calls with 0, 1, 2 … at a rate [1/s] for a time [s]; gives the rate that it reached."""
    start, number = time.monotonic(), 0
    while (elapsed := time.monotonic() - start) < seconds:
        for each in range(number, int(elapsed * rate)):
            work(each)
        number = max(number, int(elapsed * rate))
        time.sleep(0.5 / rate if rate < 500 else 0.001)
    return number / (time.monotonic() - start)


@contextmanager
def new_publisher() -> Iterator[Publisher]:
    """A publisher that has not met any recorder yet."""
    rclpy.init(args=[])
    node = rclpy.create_node('load')
    try:
        yield Publisher(node)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
