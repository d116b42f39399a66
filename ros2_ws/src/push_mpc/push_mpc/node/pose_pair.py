"""Pairs each pose of the object with the pose of the tip that was taken nearest to its time."""

import math
import time
from collections.abc import Callable

from geometry_msgs.msg import PoseStamped
from push_node import interface
from push_node.endpoints import GraphTopic
from push_node.qos import POSE_HISTORY, POSE_SUBSCRIPTION
from push_node.stamps import to_nanoseconds, to_seconds
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rosgraph_msgs.msg import Clock

from push_mpc.estimate import PoseGate, TipHistory

_NEVER = -(2**62)  # [ns]
_FRESH = 0.5  # [s]
_SET_BACK = 0.02  # [s] by which stamps go back only if a clock was set


class PosePair:
    """Subscribes to both poses and calls back once for each new pair that passes the gate.

    In real time a pose of the object pairs with the nearest of the last poses of the tip if their
    stamps differ by no more than a tolerance; where none does yet, it waits for the next ones. In
    lockstep the stamps are equal, `/clock` is a third message of the pair, and the simulator
    repeats all three until a command answers them; in a period without a picture, poses that are
    not numbers say so.

    Attributes:
        object_pose: of the newest accepted pair.
        tip: of the newest accepted pair.
        problem: why poses that arrive are not used, empty if the last one was used.
    """

    def __init__(
        self,
        node: Node,
        gate: PoseGate,
        tolerance: float | None,
        on_pair: Callable[[int, float, float], None],
        on_nothing: Callable[[int, float], None],
        on_refused: Callable[[str], None],
        on_repeat: Callable[[], None],
    ) -> None:
        """Subscribes.

        Args:
            node: the node that listens.
            gate: checks every pose.
            tolerance: difference of two stamps [s] that still pair; None in lockstep, where
                /clock is the time.
            on_pair: called with stamp of the exposure [ns], exposure [s], current time [s].
            on_nothing: called with stamp [ns] and current time [s] of a period of lockstep without
                a picture.
            on_refused: called with the reason when a pair is refused.
            on_repeat: called when the simulator repeats the last pair.
        """
        self.object_pose = PoseStamped()
        self.tip = PoseStamped()
        self._object = self.object_pose
        self._tips: TipHistory[PoseStamped] = TipHistory()
        self._gate = gate
        self._on_pair, self._on_nothing = on_pair, on_nothing
        self._on_refused, self._on_repeat = on_refused, on_repeat
        self._node = node
        self._node_clock = node.get_clock()
        self._lockstep = tolerance is None
        self._tolerance = round(1e9 * (tolerance or 0.0))
        self._accepted = float('-inf')
        self.restart()
        interface.OBJECT_POSE.subscription(node, self._on_object, qos=POSE_SUBSCRIPTION)
        interface.PUSHER_POSE.subscription(node, self._on_tip, qos=POSE_HISTORY)
        if self._lockstep:
            interface.CLOCK.subscription(node, self._on_clock, qos=QoSProfile(depth=1))

    def restart(self) -> None:
        """Forgets all pairs: time [s] counts from the next one."""
        self.problem = self._set_back = ''
        self._origin: int | None = None
        self._handled = self._handled_clock = self._clock = self._newest = _NEVER
        self._object_stamp = _NEVER
        self._tips.clear()
        self._gate.forget()
        self._arrival = time.monotonic()

    def rewind(self) -> None:
        """Accepts stamps older than the last pair's: a clock was set, or the plant restarted."""
        self._handled = self._handled_clock = self._newest = _NEVER
        self._set_back = ''

    @property
    def age(self) -> float:
        """Time [s] since the last accepted pair arrived, or since a restart."""
        return time.monotonic() - self._arrival

    @property
    def fresh(self) -> bool:
        """Whether a pair was accepted within the last half second."""
        return time.monotonic() - self._accepted < _FRESH

    def now(self) -> tuple[int, float]:
        """Current time as a stamp [ns], and in seconds since the first pair."""
        now = self._clock if self._lockstep else int(self._node_clock.now().nanoseconds)
        return now, to_seconds(now - (now if self._origin is None else self._origin))

    def explanation(self) -> str:
        """Why no pair is accepted; empty if unknown."""
        if self.problem:
            return self.problem
        nearest = self._tips.nearest(self._object_stamp)
        if self._object_stamp == _NEVER:
            return self._silence(interface.OBJECT_POSE)
        if nearest is None:
            return self._silence(interface.PUSHER_POSE)
        if self._lockstep and self._clock == _NEVER:
            return 'nothing on /clock; this node is in lockstep, is the plant in real time?'
        apart = abs(self._object_stamp - nearest[0])
        if apart > self._tolerance:
            return (
                f'the stamps of object and tip differ by {1e-6 * apart:.3g} ms, '
                f'more than poses.pair_tolerance of {1e-6 * self._tolerance:.3g} ms'
            )
        return ''

    def _silence(self, topic: GraphTopic) -> str:
        publishers = self._node.get_publishers_info_by_topic(topic.name)
        if not publishers:
            return f'nobody publishes {topic.name}'
        others = {each.topic_type for each in publishers} - {topic.type_name}
        if others:
            return f'{topic.name} is published as {", ".join(others)}, not {topic.type_name}'
        return f'nothing arrives on {topic.name}'

    def _on_object(self, message: PoseStamped) -> None:
        self._object = message
        self._object_stamp = to_nanoseconds(message.header.stamp)
        self._handle_if_complete()

    def _on_tip(self, message: PoseStamped) -> None:
        self._tips.add(to_nanoseconds(message.header.stamp), message)
        self._handle_if_complete()

    def _on_clock(self, message: Clock) -> None:
        self._clock = to_nanoseconds(message.clock)
        if self._clock == self._handled_clock:
            self._take_again()
        else:
            self._handle_if_complete()

    def _take_again(self) -> None:
        """Takes the pair that the waiting simulator repeats; after a reset it may be elsewhere."""
        nearest = self._tips.nearest(self._object_stamp)
        if nearest is not None:
            self.object_pose, self.tip = self._object, nearest[1]
        self._accepted = time.monotonic()
        self._on_repeat()

    def _handle_if_complete(self) -> None:
        stamp = self._object_stamp
        nearest = None if stamp == self._handled else self._tips.nearest(stamp)
        if nearest is None or abs(stamp - nearest[0]) > self._tolerance:
            return
        if self._lockstep and self._clock in (_NEVER, self._handled_clock):
            return
        if self._lockstep and math.isnan(self._object.pose.position.x):
            self._handled, self._handled_clock = stamp, self._clock
            self._on_nothing(stamp, self.now()[1])
            return
        self.problem = self._fault(stamp, nearest[1])
        if self.problem:
            self._on_refused(self.problem)
            return
        self.object_pose, self.tip = self._object, nearest[1]
        self._handled, self._handled_clock = stamp, self._clock
        self._newest = stamp
        self._origin = stamp if self._origin is None else self._origin
        self._arrival = self._accepted = time.monotonic()
        self._on_pair(stamp, to_seconds(stamp - self._origin), self.now()[1])

    def _fault(self, stamp: int, tip: PoseStamped) -> str:
        """Why the newest object pose and this of the tip are refused, empty if they are not."""
        now = self.now()[0]
        for topic, message in (
            (interface.OBJECT_POSE, self._object),
            (interface.PUSHER_POSE, tip),
        ):
            age = to_seconds(now - to_nanoseconds(message.header.stamp))
            place, turn = message.pose.position, message.pose.orientation
            rejection = self._gate.check(
                topic.name,
                message.header.frame_id,
                (place.x, place.y, place.z),
                (turn.x, turn.y, turn.z, turn.w),
                age,
            )
            if rejection:
                return rejection.reason
        return self._set_back or self._return_fault(stamp)

    def _return_fault(self, stamp: int) -> str:
        """What is wrong with a stamp [ns] that is older than the last one, empty if it is not.

        Where a clock was set back, all stamps that follow are wrong by as much.
        """
        if stamp >= self._newest:
            return ''
        back = to_seconds(self._newest - stamp)
        fault = f'the stamps went back by {back:.3g} s'
        if not self._lockstep and back > _SET_BACK:
            self._set_back = f'{fault}; are the clocks synchronised?'
        return self._set_back or fault
