"""The recorder as a child process, and a publisher that counts what it sends."""

import os
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
from push_bag.file import message_class
from push_core.common import RunError
from push_msgs.msg import Horizon
from push_node.interface import TOPICS
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import ByteMultiArray
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

READY_TIMEOUT = 30.0  # [s]
ARRIVAL_TIMEOUT = 5.0  # [s]
MEGABYTE = 1024.0 * 1024.0  # [B]
TICK_TOPICS = ('object_pose', 'pusher_pose', 'pusher_velocity_cmd', 'controller_state', '/tf')
SLOW_TOPICS = ('horizon', 'scene')
SLOW_TICKS = 5
HORIZON = array('d', range(36))
# topics whose messages are larger than an empty one
FILLED = {
    'horizon': Horizon(x=HORIZON, y=HORIZON, theta=HORIZON),
    'scene': MarkerArray(markers=[Marker(), Marker()]),
    '/tf': TFMessage(transforms=[TransformStamped(), TransformStamped()]),
}


class RecorderProcess:
    """The recorder node as a child process; a context manager that kills it at the end."""

    def __init__(self, folder: Path, *parameters: str) -> None:
        """Starts the recorder.

        Args:
            folder: of the run; must not exist yet.
            parameters: of the node, as NAME:=VALUE.
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
        """Ends the recorder with SIGKILL."""
        self._process.kill()
        self._process.wait()
        if self._process.stderr is not None:
            self._process.stderr.close()

    def stop(self) -> str:
        """Ends the recorder with SIGINT; returns what it wrote to standard error."""
        self._process.send_signal(signal.SIGINT)
        return self._process.communicate(timeout=READY_TIMEOUT)[1].strip()

    @property
    def processor_time(self) -> float:
        """Processor time [s] used so far, by user and system."""
        fields = Path(f'/proc/{self._process.pid}/stat').read_text().rpartition(')')[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')

    @property
    def memory(self) -> float:
        """Resident memory [MB]."""
        pages = Path(f'/proc/{self._process.pid}/statm').read_text().split()[1]
        return int(pages) * os.sysconf('SC_PAGE_SIZE') / MEGABYTE


class Publisher:
    """Publishes the topics of a cell, and `load` with messages of 1 KB."""

    def __init__(self, node: Node) -> None:
        self._outlets: dict[str, Any] = {
            topic.name: node.create_publisher(
                message_class(topic.type_name), topic.name, topic.qos
            )
            for topic in TOPICS
            if topic.core or topic.name in FILLED
        }
        self._outlets['load'] = node.create_publisher(
            ByteMultiArray, 'load', QoSProfile(depth=100)
        )
        self._payload = ByteMultiArray(data=[bytes([each % 256]) for each in range(1000)])
        self.sent = dict.fromkeys(self._outlets, 0)
        self.sent_at: dict[str, list[int]] = {name: [] for name in self._outlets}

    def wait(self) -> None:
        """Waits until every topic has a subscriber.

        Raises:
            RunError: a topic has none after READY_TIMEOUT.
        """
        end = time.monotonic() + READY_TIMEOUT
        while not all(each.get_subscription_count() for each in self._outlets.values()):
            if time.monotonic() > end:
                raise RunError('the recorder does not subscribe to every topic')
            time.sleep(0.02)

    def tick(self, number: int) -> None:
        """Publishes the messages of one tick of the cell."""
        for name in TICK_TOPICS + (SLOW_TOPICS if number % SLOW_TICKS == 0 else ()):
            self.send(name, FILLED.get(name) or self._outlets[name].msg_type())

    def load(self, _number: int) -> None:
        """Publishes one message of 1 KB."""
        self.send('load', self._payload)

    def wait_until_acknowledged(self) -> None:
        """Waits until the subscribers acknowledged all messages, at most ARRIVAL_TIMEOUT."""
        for each in self._outlets.values():
            each.wait_for_all_acked(Duration(seconds=ARRIVAL_TIMEOUT))

    def send(self, name: str, message: Any) -> None:
        """Publishes one message and counts it."""
        self._outlets[name].publish(message)
        self.sent[name] += 1
        self.sent_at[name].append(time.time_ns())


def at_rate(work: Callable[[int], None], rate: float, seconds: float) -> float:
    """Calls `work` with 0, 1, 2 … at a rate [1/s] for a time [s]; returns the rate reached."""
    start, number = time.monotonic(), 0
    while (elapsed := time.monotonic() - start) < seconds:
        for each in range(number, int(elapsed * rate)):
            work(each)
        number = max(number, int(elapsed * rate))
        time.sleep(0.5 / rate if rate < 500 else 0.001)
    return number / (time.monotonic() - start)


@contextmanager
def new_publisher() -> Iterator[Publisher]:
    """A publisher on a node of its own."""
    rclpy.init(args=[])
    node = rclpy.create_node('load')
    try:
        yield Publisher(node)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
