"""Listens to a driver, and moves its tip a little."""

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from geometry_msgs.msg import PoseStamped, TwistStamped
from push_core.common import RunError
from push_core.geometry import Array
from push_node import interface
from push_node.endpoints import GraphTopic
from push_node.qos import POSE_SUBSCRIPTION
from push_node.spin import Spinner
from push_node.stamps import to_nanoseconds, to_stamp
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from push_bringup.driver_check.contract import Point
from push_bringup.driver_check.heard_poses import HeardPoses, TipMotion

DISCOVERY_TIME = 2.0  # [s]
SETTLING_TIME = 0.8  # [s] after which a commanded stop must be over
_PERIOD = 0.01  # [s] of commands
_POSES = (interface.OBJECT_POSE, interface.PUSHER_POSE)


class DriverClient:
    """Stands where the controller would."""

    def __init__(self, node: Node) -> None:
        """Subscribes and advertises on a node."""
        self._node, self._spinner = node, Spinner(node)
        self._clock = node.get_clock()
        self._heard: dict[str, list[tuple[int, PoseStamped]]] = {}
        for topic in _POSES:
            self._heard[topic.name] = []
            topic.subscription(node, self._keeper(topic), qos=POSE_SUBSCRIPTION)
        self._commands = interface.PUSHER_VELOCITY_CMD.publisher(node)
        self._velocity: Array | None = None
        node.create_timer(_PERIOD, self._command, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def listen(self, seconds: float) -> None:
        """Receives for a time.

        Raises:
            KeyboardInterrupt: a stop was requested.
        """
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            if not self._spinner.once():
                raise KeyboardInterrupt

    def forget(self) -> None:
        """Forgets what was heard."""
        for messages in self._heard.values():
            messages.clear()

    def heard(self, topic: GraphTopic) -> HeardPoses:
        """What was heard on a pose topic."""
        messages = self._heard[topic.name]
        return HeardPoses(
            topic.name,
            np.array([to_nanoseconds(m.header.stamp) for _, m in messages], np.int64),
            np.array([arrival for arrival, _ in messages], np.int64),
            np.array([_position(m) for _, m in messages], np.float64).reshape(-1, 3),
            np.array([_quaternion(m) for _, m in messages], np.float64).reshape(-1, 4),
            [m.header.frame_id for _, m in messages],
        )

    def graph_points(self) -> list[Point]:
        """Whether one node publishes each pose, and who takes and sends the commands."""
        points = [self._publisher_point(topic) for topic in _POSES]
        command = interface.PUSHER_VELOCITY_CMD
        takers = self._node.get_subscriptions_info_by_topic(command.name)
        # a recorder takes them as well
        kept = command.type_name in {each.topic_type for each in takers}
        points.append(Point(f'{command.name} is taken', kept, f'{len(takers)} subscribers'))
        rivals = self._node.count_publishers(command.name) - 1
        points.append(
            Point('nobody else commands', not rivals, f'{rivals} other nodes on {command.name}')
        )
        return points

    def move(self, velocity: Array, duration: float) -> TipMotion:
        """Moves the tip forth and back; commands cease at the end of the way back.

        Args:
            velocity: forth (2,) [m/s].
            duration: of each way [s].

        Raises:
            KeyboardInterrupt: a stop was requested; the driver stops for want of commands.
        """
        start = self._send(velocity, duration)
        stopped = self._send(np.zeros(2), SETTLING_TIME)
        back = self._send(-velocity, duration)
        self._velocity, silent = None, self._now()
        self.listen(SETTLING_TIME)
        tip = self.heard(interface.PUSHER_POSE)
        return TipMotion(velocity, duration, start, stopped, back, silent, self._now(), tip)

    def away(self) -> Array:
        """Unit vector (2,) from the object to the tip.

        Raises:
            RunError: a pose is missing.
        """
        poses = [self.heard(topic) for topic in _POSES]
        if not all(map(len, poses)):
            raise RunError('no poses: nothing was moved')
        apart = poses[1].position[-1, :2] - poses[0].position[-1, :2]
        return np.asarray(apart / np.hypot(*apart))

    def _send(self, velocity: Array, seconds: float) -> int:
        start, self._velocity = self._now(), velocity
        self.listen(seconds)
        return start

    def _now(self) -> int:
        return int(self._clock.now().nanoseconds)

    def _command(self) -> None:
        if self._velocity is None:
            return
        message = TwistStamped()
        message.header.frame_id, message.header.stamp = 'world', to_stamp(self._now())
        message.twist.linear.x, message.twist.linear.y = map(float, self._velocity)
        self._commands.publish(message)

    def _keeper(self, topic: GraphTopic) -> Callable[[Any], None]:
        messages = self._heard[topic.name]
        return lambda message: messages.append((self._now(), message))

    def _publisher_point(self, topic: GraphTopic) -> Point:
        found = self._node.get_publishers_info_by_topic(topic.name)
        kept = [each.topic_type for each in found] == [topic.type_name]
        text = ', '.join(
            f'{each.node_name} ({each.topic_type}, {each.qos_profile.reliability.name.lower()})'
            for each in found
        )
        return Point(f'{topic.name} has one publisher', kept, text or 'none')


def _position(message: PoseStamped) -> tuple[float, float, float]:
    place = message.pose.position
    return place.x, place.y, place.z


def _quaternion(message: PoseStamped) -> tuple[float, float, float, float]:
    turn = message.pose.orientation
    return turn.x, turn.y, turn.z, turn.w
