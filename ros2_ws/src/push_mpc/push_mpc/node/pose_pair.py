"""Pairs the poses of object and tip that carry the same stamp."""

import time
from collections.abc import Callable

from geometry_msgs.msg import PoseStamped
from push_node import interface
from push_node.stamps import to_nanoseconds, to_seconds
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rosgraph_msgs.msg import Clock


class PosePair:
    """Subscribes to both poses and calls back once for each new pair.

    In lockstep `/clock` is a third message of the pair, and the simulator repeats all three until
    a command answers them.

    Attributes:
        object_pose: newest pose of the object.
        tip: newest pose of the tip.
        seen: whether any pair has arrived since the node started.
    """

    def __init__(
        self,
        node: Node,
        lockstep: bool,
        on_pair: Callable[[int, float, float], None],
        on_repeat: Callable[[], None],
    ) -> None:
        """Subscribes.

        Args:
            node: the node that listens.
            lockstep: whether /clock is the time.
            on_pair: called with stamp of the exposure [ns], exposure [s], current time [s].
            on_repeat: called when the simulator repeats the last pair.
        """
        self.object_pose = PoseStamped()
        self.tip = PoseStamped()
        self.seen = False
        self._on_pair, self._on_repeat = on_pair, on_repeat
        self._node_clock = node.get_clock()
        self._lockstep = lockstep
        self.restart()
        interface.OBJECT_POSE.subscription(node, self._on_object)
        interface.PUSHER_POSE.subscription(node, self._on_tip)
        if lockstep:
            interface.CLOCK.subscription(node, self._on_clock, qos=QoSProfile(depth=1))

    def restart(self) -> None:
        """Forgets all pairs: time [s] counts from the next one."""
        self._origin = -1
        self._handled = self._handled_clock = -1
        self._clock = -1
        self._object_stamp, self._tip_stamp = -1, -2
        self._arrival = time.monotonic()

    @property
    def age(self) -> float:
        """Time [s] since the last pair arrived, or since a restart."""
        return time.monotonic() - self._arrival

    def now(self) -> tuple[int, float]:
        """Current time as a stamp [ns], and in seconds since the first pair."""
        now = self._clock if self._lockstep else int(self._node_clock.now().nanoseconds)
        return now, to_seconds(now - self._origin)

    def _on_object(self, message: PoseStamped) -> None:
        self.object_pose = message
        self._object_stamp = to_nanoseconds(message.header.stamp)
        self._handle_if_complete()

    def _on_tip(self, message: PoseStamped) -> None:
        self.tip = message
        self._tip_stamp = to_nanoseconds(message.header.stamp)
        self._handle_if_complete()

    def _on_clock(self, message: Clock) -> None:
        self._clock = to_nanoseconds(message.clock)
        if self._clock == self._handled_clock:
            self._on_repeat()
        else:
            self._handle_if_complete()

    def _handle_if_complete(self) -> None:
        stamp = self._object_stamp
        if stamp != self._tip_stamp or stamp <= self._handled:
            return
        if self._lockstep and self._clock <= self._handled_clock:
            return
        self._handled, self._handled_clock = stamp, self._clock
        self._origin = stamp if self._origin < 0 else self._origin
        self._arrival = time.monotonic()
        self.seen = True
        self._on_pair(stamp, to_seconds(stamp - self._origin), self.now()[1])
