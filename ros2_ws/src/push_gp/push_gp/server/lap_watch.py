"""Follows a cell by its topics and cuts what happens into laps."""

from collections import deque
from collections.abc import Callable
from typing import Any

import numpy as np
from geometry_msgs.msg import PoseStamped
from push_core.geometry import Array, quaternion_to_yaw
from push_msgs.msg import ControllerState, NominalTrajectory
from push_node import interface
from push_node.publishers import lossless
from push_node.qos import POSE_HISTORY
from push_node.stamps import to_nanoseconds
from rclpy.node import Node

from push_gp.learn import LapCollector, Measured, MeasuredLap, TimedReference
from push_gp.server.conversions import reference_of

_FOLLOWING = (ControllerState.TRACKING, ControllerState.RECONTACT)


class LapWatch:
    """Pairs the ticks of the controller with the poses that they answered."""

    def __init__(
        self,
        node: Node,
        mode: str,
        on_begin: Callable[[TimedReference], None],
        on_piece: Callable[[MeasuredLap], None],
        on_lap: Callable[[MeasuredLap | None], None],
    ) -> None:
        """Subscribes.

        Args:
            node: that listens.
            mode: lockstep, where every message arrives, or realtime.
            on_begin: called when a run begins.
            on_piece: called at the end of each piece of a lap.
            on_lap: called at the end of each lap; None for a last lap that was not seen.
        """
        self._on_begin, self._on_piece, self._on_lap = on_begin, on_piece, on_lap
        self._plan: NominalTrajectory | None = None
        self._collector: LapCollector | None = None
        self._states: deque[ControllerState] = deque()
        self._object, self._tip = _Poses(), _Poses()
        self._mode = ControllerState.IDLE
        poses = lossless(POSE_HISTORY) if mode == 'lockstep' else POSE_HISTORY
        states = lossless(interface.CONTROLLER_STATE.qos)
        interface.NOMINAL_TRAJECTORY.subscription(node, self._on_plan)
        interface.OBJECT_POSE.subscription(node, self._heard(self._object), qos=poses)
        interface.PUSHER_POSE.subscription(node, self._heard(self._tip), qos=poses)
        interface.CONTROLLER_STATE.subscription(node, self._on_state, qos=states)

    def _on_plan(self, message: NominalTrajectory) -> None:
        self._plan = message

    def _heard(self, poses: '_Poses') -> Callable[[PoseStamped], None]:
        def on_pose(message: PoseStamped) -> None:
            poses.add(message)
            self._pair()

        return on_pose

    def _on_state(self, message: ControllerState) -> None:
        self._states.append(message)
        self._pair()

    def _pair(self) -> None:
        """Takes the ticks in their order, each when its poses are here or will not come."""
        while self._states:
            state = self._states[0]
            stamp = to_nanoseconds(state.header.stamp)
            measured = state.mode in _FOLLOWING and state.reference_time > 0.0
            if measured and not (self._object.settled(stamp) and self._tip.settled(stamp)):
                return
            self._states.popleft()
            self._follow(state)
            if measured:
                self._measure(state, self._object.take(stamp), self._tip.take(stamp))

    def _follow(self, state: ControllerState) -> None:
        """Begins a run or ends one."""
        before, self._mode = self._mode, state.mode
        if state.mode == before:
            return
        if state.mode == ControllerState.ARMED and self._plan is not None:
            reference = reference_of(self._plan)
            self._collector = LapCollector(reference.lap_time, reference.laps, reference.speed)
            self._on_begin(reference)
        if state.mode == ControllerState.DONE:
            self._on_lap(self._collector.finish() if self._collector else None)
            self._collector = None

    def _measure(
        self, state: ControllerState, pose: PoseStamped | None, tip: PoseStamped | None
    ) -> None:
        if self._collector is None or pose is None or tip is None:
            return
        place, turn = pose.pose.position, pose.pose.orientation
        piece, lap = self._collector.add(
            Measured(
                state.reference_time,
                state.mode == ControllerState.TRACKING,
                np.array([place.x, place.y, quaternion_to_yaw(turn.z, turn.w)]),
                _position(tip),
                state.model_id,
            )
        )
        if piece is not None:
            self._on_piece(piece)
        if lap is not None:
            self._on_lap(lap)


class _Poses:
    """The newest poses of a topic, by stamp [ns]."""

    def __init__(self) -> None:
        self._newest = 0
        self._waiting: dict[int, PoseStamped] = {}

    def add(self, message: PoseStamped) -> None:
        self._newest = to_nanoseconds(message.header.stamp)
        self._waiting[self._newest] = message

    def settled(self, stamp: int) -> bool:
        """Whether the pose with a stamp is here, or was lost: those of a topic come in order."""
        return self._newest >= stamp

    def take(self, stamp: int) -> PoseStamped | None:
        """The pose with a stamp, None if it was lost; those before it are forgotten."""
        self._waiting = {when: each for when, each in self._waiting.items() if when >= stamp}
        return self._waiting.pop(stamp, None)


def _position(message: Any) -> Array:
    return np.array([message.pose.position.x, message.pose.position.y])
