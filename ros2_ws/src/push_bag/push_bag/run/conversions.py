"""Converts recorded messages to arrays; no other module knows their fields.

Topics with a message per tick are decoded by columns (`cdr_columns`), rare ones as messages.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from push_core.common import InputError
from push_core.geometry import quaternion_to_yaw
from push_node.stamps import NANOSECONDS, to_nanoseconds

from push_bag.file import Columns
from push_bag.run.series import DrivenLesson, Floats, ModelFacts, PerturbationEvent, Reference

STAMP = ('header.stamp.sec', 'header.stamp.nanosec')
UNIT_TOLERANCE = 0.01  # of the squared norm of a quaternion, as in tf2
UPRIGHT = 0.5  # z^2 + w^2 of a quaternion that tilts by a right angle
# fields of the topics that are decoded by columns
POSE_FIELDS = (
    *STAMP,
    'pose.position.x',
    'pose.position.y',
    'pose.orientation.z',
    'pose.orientation.w',
)
ORIENTED_POSE_FIELDS = (*POSE_FIELDS, 'pose.orientation.x', 'pose.orientation.y')
TWIST_FIELDS = (*STAMP, 'twist.linear.x', 'twist.linear.y')
TRUTH_FIELDS = (*STAMP, 'pose')
SOLVER_FIELDS = ('solve_ms', 'tick_ms', 'iterations', 'solver_status', 'limited', 'tick')
STATE_FIELDS = (
    *STAMP,
    'mode',
    'stop_reason',
    'model_id',
    'reference_time',
    'state',
    'input',
    'nominal_input',
    'predicted',
    'reference',
    *SOLVER_FIELDS,
)
OPTIONAL_STATE_FIELDS = {'disturbance': 3, 'innovation': 3, 'innovation_deviation': 3}


def stamps(columns: Columns) -> NDArray[np.int64]:
    """Stamps (n,) of the messages' headers [ns]."""
    sec, nanosec = (columns[name].astype(np.int64) for name in STAMP)
    return np.asarray(sec * NANOSECONDS + nanosec)


def planar_poses(columns: Columns) -> Floats:
    """X [m], y [m] and heading [rad] (n, 3) of poses that rotate about z only."""
    turns = zip(columns['pose.orientation.z'], columns['pose.orientation.w'], strict=True)
    yaw = [quaternion_to_yaw(z, w) if math.isfinite(z + w) else math.nan for z, w in turns]
    return np.column_stack([columns['pose.position.x'], columns['pose.position.y'], yaw])


def measured_poses(columns: Columns) -> Floats:
    """X [m], y [m] and heading [rad] (n, 3) of poses.

    The heading is NaN where the orientation is no unit quaternion, as tf2 defines it, or tilts the
    object by more than a right angle.
    """
    poses = planar_poses(columns)
    x, y, z, w = (columns[f'pose.orientation.{axis}'] for axis in 'xyzw')
    upright = z**2 + w**2
    is_rotation = (np.abs(x**2 + y**2 + upright - 1.0) <= UNIT_TOLERANCE) & (upright >= UPRIGHT)
    poses[~is_rotation, 2] = np.nan
    return poses


def positions(columns: Columns) -> Floats:
    """X and y [m] (n, 2) of poses."""
    return np.column_stack([columns['pose.position.x'], columns['pose.position.y']])


def true_poses(columns: Columns) -> Floats:
    """X [m], y [m] and heading [rad] (n, 3) of the object in ground truths."""
    return np.asarray(columns['pose'], np.float64)


def velocities(columns: Columns) -> Floats:
    """v_x and v_y [m/s] (n, 2) of twists."""
    return np.column_stack([columns['twist.linear.x'], columns['twist.linear.y']])


def ticks(columns: Columns) -> Floats:
    """Controller states (n, 26) with the columns STATE_COLUMNS."""
    parts = [columns['mode'], columns['reference_time'], columns['state'][:, 3]]
    parts += [columns['input'], columns['nominal_input']]
    parts += [columns[name] for name in SOLVER_FIELDS]
    parts += [columns['predicted'][:, :2], columns['reference'][:, :2]]
    parts += [columns[name] for name in OPTIONAL_STATE_FIELDS]
    return np.column_stack(parts).astype(np.float64)


def nanoseconds(message: Any) -> int:
    """The stamp of a message's header [ns]."""
    return to_nanoseconds(message.header.stamp)


def reference(message: Any) -> Reference:
    """The reference of a NominalTrajectory message.

    Raises:
        InputError: its arrays are empty or of different lengths, its poses no numbers, or its
            times do not increase.
    """
    arrays = [message.time, message.x, message.y, message.theta, message.p_y]
    arrays += [message.v_n, message.v_t]
    if len(message.time) < 2 or len({len(array) for array in arrays}) != 1:
        raise InputError('the recorded nominal trajectory is not a series of samples')
    time, x, y, theta, p_y, v_n, v_t = (np.asarray(array, np.float64) for array in arrays)
    if not np.isfinite([time, x, y, theta]).all() or (np.diff(time) <= 0.0).any():
        raise InputError('the recorded nominal trajectory has times or poses that cannot be')
    return Reference(
        track=message.track,
        controller=message.controller,
        speed=message.speed,
        side=message.side,
        tip_radius=message.tip_radius,
        laps=message.laps,
        time=time,
        pose=np.stack([x, y, theta], axis=1),
        p_y=p_y,
        input=np.stack([v_n, v_t], axis=1),
    )


def model(message: Any) -> ModelFacts:
    """The facts of a ModelInfo message."""
    return ModelFacts(message.points, message.model_hash, message.kind)


def lesson(message: Any, since: int) -> DrivenLesson:
    """What a Lesson message tells, driven from a tick with a stamp [ns] on."""
    deviations = np.sqrt(np.reshape(message.covariance, (2, 2)).diagonal())
    return DrivenLesson(
        since=since,
        pushes=message.pushes,
        friction=(message.friction, message.friction * float(deviations[0])),
        support_radius=(message.support_radius, message.support_radius * float(deviations[1])),
        shift=np.reshape(message.shift, (-1, 2)),
    )


def perturbation(message: Any) -> PerturbationEvent:
    """The event of a Perturbation message."""
    return PerturbationEvent(nanoseconds(message), message.kind, message.magnitude)
