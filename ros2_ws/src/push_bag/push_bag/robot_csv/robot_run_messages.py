"""A measured run as the messages that a cell would have published."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from geometry_msgs.msg import PoseStamped, TwistStamped
from push_core.data import RobotRun
from push_core.geometry import yaw_to_quaternion
from push_core.physics import Slider
from push_msgs.msg import ControllerState, NominalTrajectory
from push_node.interface import (
    CONTROLLER_STATE,
    NOMINAL_TRAJECTORY,
    OBJECT_POSE,
    PUSHER_POSE,
    PUSHER_VELOCITY_CMD,
)
from push_node.stamps import to_stamp
from rclpy.serialization import serialize_message

from push_bag.file import qos_text
from push_bag.robot_csv.lost_rows import lost_rows
from push_bag.robot_csv.reference_line import ReferenceLine
from push_bag.run import Floats

START_NS = 1_000_000_000  # stamp of the first row
WRITTEN = (
    *(OBJECT_POSE, PUSHER_POSE, PUSHER_VELOCITY_CMD),
    *(NOMINAL_TRAJECTORY, CONTROLLER_STATE),
)
UNKNOWN = math.nan
SLOPE_TIME = 0.01  # [s] over which a slope is taken: the rows come unevenly


def topics() -> list[tuple[str, str, str]]:
    """Name, type and QoS of the topics, for `BagWriter.add_topic`."""
    return [(each.absolute_name, each.type_name, qos_text(each.qos)) for each in WRITTEN]


class RobotMessage(NamedTuple):
    """A serialized message: topic, bytes, stamp [ns] and the number by its publisher."""

    topic: str
    data: bytes
    stamp: int
    sequence: int


def messages(run: RobotRun, slider: Slider, line: ReferenceLine) -> Iterator[RobotMessage]:
    """Every message in order of time; the numbers skip rows that are missing.

    Args:
        run: the measured run.
        slider: the object and the tip.
        line: that the run followed.
    """
    plan = serialize_message(_reference(run, slider, line))
    yield RobotMessage(NOMINAL_TRAJECTORY.absolute_name, plan, START_NS, 1)
    velocity, progress = _commanded_velocity(run), _progress(run, line)
    numbers = 1 + np.arange(len(run.time)) + np.cumsum(lost_rows(run.time))
    targets = np.column_stack(
        [line.points(progress), np.full(len(run.time), line.heading), np.zeros(len(run.time))]
    )
    for row, time in enumerate(run.time.tolist()):
        stamp = START_NS + round(time * 1e9)
        last = row == len(run.time) - 1
        for topic, message in (
            (OBJECT_POSE, _pose_message(run.pose[row])),
            (PUSHER_POSE, _pose_message(np.array([*run.tip[row], 0.0]))),
            (PUSHER_VELOCITY_CMD, _velocity_message(velocity[row])),
            (CONTROLLER_STATE, _state(run, slider, row, targets[row], last)),
        ):
            message.header.frame_id, message.header.stamp = 'world', to_stamp(stamp)
            data, number = serialize_message(message), int(numbers[row])
            yield RobotMessage(topic.absolute_name, data, stamp, number)


def _commanded_velocity(run: RobotRun) -> Floats:
    """Slopes (n, 2) [m/s] of the commanded positions."""
    half = 0.5 * SLOPE_TIME
    ahead, behind = (
        np.stack([np.interp(time, run.time, each) for each in run.commanded.T], axis=1)
        for time in (run.time + half, run.time - half)
    )
    return np.asarray((ahead - behind) / SLOPE_TIME)


def _progress(run: RobotRun, line: ReferenceLine) -> Floats:
    """Distance (n,) [m] of the object along the line; it never decreases."""
    return np.asarray(np.maximum.accumulate(line.along(run.pose[:, :2])))


def _pose_message(pose: Floats) -> Any:
    message = PoseStamped()
    message.pose.position.x, message.pose.position.y = pose[:2].tolist()
    _, _, message.pose.orientation.z, message.pose.orientation.w = yaw_to_quaternion(pose[2])
    return message


def _velocity_message(velocity: Floats) -> Any:
    message = TwistStamped()
    message.twist.linear.x, message.twist.linear.y = velocity.tolist()
    return message


def _state(run: RobotRun, slider: Slider, row: int, reference: Floats, last: bool) -> Any:
    pose, tip = run.pose[row], run.tip[row]
    state = np.array([*pose, slider.contact_offset(pose, tip)])
    message = ControllerState(
        tick=row,
        mode=ControllerState.DONE if last else ControllerState.TRACKING,
        reference_time=float(run.time[row]),
        exposure=float(run.time[row]),
        now=UNKNOWN,
        state=state,
        predicted=state,
        reference=reference,
        gap=float(slider.gap(pose, tip)),
        solve_ms=UNKNOWN,
        tick_ms=UNKNOWN,
    )
    message.input = message.nominal_input = np.array([UNKNOWN, UNKNOWN])
    return message


def _reference(run: RobotRun, slider: Slider, line: ReferenceLine) -> Any:
    """The reference: the line, timed by the object's own progress."""
    count = len(run.time)
    time = np.linspace(0.0, run.time[-1], count)
    along = np.interp(time, run.time, _progress(run, line))
    points, zero = line.points(along), np.zeros(count)
    message = NominalTrajectory(
        track=Path(run.name).stem,
        controller='robot',
        speed=float((along[-1] - along[0]) / time[-1]),
        side=slider.side,
        tip_radius=slider.tip_radius,
        laps=1,
    )
    message.header.frame_id, message.header.stamp = 'world', to_stamp(START_NS)
    message.time, message.theta = time.tolist(), np.full(count, line.heading).tolist()
    message.x, message.y = points[:, 0].tolist(), points[:, 1].tolist()
    message.p_y = message.v_t = zero.tolist()
    message.v_n = np.gradient(along, time).tolist()
    return message
