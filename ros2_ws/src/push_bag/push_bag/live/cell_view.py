"""What the page of a running cell shows: the newest messages as JSON."""

import json
import math
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray
from push_core.geometry import quaternion_to_yaw
from push_msgs.msg import ControllerState, NominalTrajectory
from push_node import interface
from push_node.endpoints import GraphTopic, short_name
from push_node.stamps import to_nanoseconds
from rclpy.serialization import deserialize_message

SILENT = 1.0  # [s] without a pose, after which nothing is said to come
_MOST_POINTS = 1500  # of the reference
_FOLLOWING = (ControllerState.TRACKING, ControllerState.RECONTACT)
_SHOWN = (
    *(interface.OBJECT_POSE, interface.PUSHER_POSE, interface.PUSHER_VELOCITY_CMD),
    *(interface.CONTROLLER_STATE, interface.HORIZON, interface.NOMINAL_TRAJECTORY),
)
_MODES = (
    *('IDLE', 'ARMED', 'TRACKING', 'DONE', 'STOPPED', 'HOLDING', 'RECONTACT'),
    *('STOPPING', 'FAULT'),
)
MODES = {int(getattr(ControllerState, name)): name.lower() for name in _MODES}


class CellView:
    """Keeps the newest message of each topic, and reads it only when a page wants it."""

    def __init__(self) -> None:
        self._raw: dict[str, bytes] = {}
        self._read: dict[str, tuple[bytes, Any]] = {}
        self._heard = -math.inf
        self._tip: tuple[int, NDArray[np.float64]] = (0, np.zeros(2))
        self._tip_velocity: list[float | None] = [None, None]
        self.plan_number = 0

    def take(self, name: str, data: bytes) -> None:
        """Keeps a serialized message of a topic."""
        topic = short_name(name)
        self._raw[topic] = data
        if topic == interface.OBJECT_POSE.short_name:
            self._heard = time.monotonic()
        if topic == interface.NOMINAL_TRAJECTORY.short_name:
            self.plan_number += 1

    def snapshot(self) -> str:
        """The present state; lengths in mm, angles in rad, velocities in mm/s."""
        silent = time.monotonic() - self._heard > SILENT
        shown = {'time': time.monotonic(), 'silent': silent, 'plan': self.plan_number}
        moving = {} if silent else self._poses() | self._controller() | self._horizon()
        return _json(shown | moving)

    def plan(self) -> str:
        """The reference: x and y, side of the object, radius of the tip, in mm."""
        plan = self._newest(interface.NOMINAL_TRAJECTORY)
        if plan is None:
            return '{}'
        step = max(1, len(plan.x) // _MOST_POINTS)
        return _json(
            {
                'x': _millimetres(plan.x[::step]),
                'y': _millimetres(plan.y[::step]),
                'side': 1e3 * plan.side,
                'tip_radius': 1e3 * plan.tip_radius,
                'title': f'{plan.track}, {1e3 * plan.speed:.4g} mm/s, {plan.controller}',
            }
        )

    def _poses(self) -> dict[str, Any]:
        pose, tip = self._newest(interface.OBJECT_POSE), self._newest(interface.PUSHER_POSE)
        command = self._newest(interface.PUSHER_VELOCITY_CMD)
        shown: dict[str, Any] = {}
        if pose is not None:
            turn, place = pose.pose.orientation, pose.pose.position
            yaw = quaternion_to_yaw(turn.z, turn.w)
            shown['object'] = [1e3 * place.x, 1e3 * place.y, yaw]
        if tip is not None:
            place = np.array([tip.pose.position.x, tip.pose.position.y])
            self._differentiate(to_nanoseconds(tip.header.stamp), place)
            shown |= {'tip': (1e3 * place).tolist(), 'tip_velocity': self._tip_velocity}
        if command is not None:
            shown['command'] = _millimetres([command.twist.linear.x, command.twist.linear.y])
        return shown

    def _differentiate(self, stamp: int, place: NDArray[np.float64]) -> None:
        before, old = self._tip
        if stamp != before:
            seconds = 1e-9 * (stamp - before)
            moved = 1e3 * (place - old) / seconds
            # after a reset the stamps begin anew
            known = 0.0 < seconds < SILENT
            self._tip_velocity = moved.tolist() if known else [None, None]
            self._tip = stamp, place

    def _controller(self) -> dict[str, Any]:
        state: ControllerState | None = self._newest(interface.CONTROLLER_STATE)
        if state is None:
            return {'mode': 'no controller'}
        follows = state.mode in _FOLLOWING
        return {
            'mode': MODES.get(state.mode, str(state.mode)),
            'reason': state.stop_reason,
            'reference_time': state.reference_time if follows else None,
            'error': self._error(state) if follows else None,
            'p_y': 1e3 * state.state[3],
            'gap': 1e3 * state.gap,
            'disturbance': [*state.disturbance],
            'solve_ms': state.solve_ms,
            'tick_ms': state.tick_ms,
            'model': state.model_id,
        }

    def _error(self, state: ControllerState) -> float | None:
        """Distance [mm] of the object from the reference of the same instant."""
        plan: NominalTrajectory | None = self._newest(interface.NOMINAL_TRAJECTORY)
        if plan is None:
            return None
        x, y = (np.interp(state.reference_time, plan.time, axis) for axis in (plan.x, plan.y))
        return 1e3 * math.hypot(state.state[0] - x, state.state[1] - y)

    def _horizon(self) -> dict[str, Any]:
        horizon = self._newest(interface.HORIZON)
        if horizon is None:
            return {}
        return {'horizon': [_millimetres(horizon.x), _millimetres(horizon.y)]}

    def _newest(self, topic: GraphTopic) -> Any:
        """The newest message of a topic; None without one."""
        name = topic.short_name
        data = self._raw.get(name)
        if data is None:
            return None
        read = self._read.get(name)
        if read is None or read[0] is not data:
            read = self._read[name] = data, deserialize_message(data, topic.message_class)
        return read[1]


def _millimetres(metres: Any) -> list[float]:
    values: list[float] = np.round(1e3 * np.asarray(metres, np.float64), 2).tolist()
    return values


def _json(value: dict[str, Any]) -> str:
    """JSON with null in place of what is no finite number, which browsers do not read."""
    return json.dumps(_finite(value), separators=(',', ':'))


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_finite(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
