"""Conversions between messages and arrays."""

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, TwistStamped
from push_core.geometry import Array, yaw_to_quaternion
from push_core.physics import Slider
from push_msgs.msg import GroundTruth
from push_msgs.msg import Perturbation as PerturbationMessage

from push_sim.plant import AppliedPerturbation, TrueState

FRAME = 'world'


def pose_message(pose: Array, stamp: Time) -> PoseStamped:
    """A pose (3,) x [m], y [m], theta [rad] in the world frame."""
    message = PoseStamped()
    message.header.frame_id = FRAME
    message.header.stamp = stamp
    message.pose.position.x, message.pose.position.y = float(pose[0]), float(pose[1])
    orientation = message.pose.orientation
    orientation.x, orientation.y, orientation.z, orientation.w = yaw_to_quaternion(float(pose[2]))
    return message


def position_message(position: Array, stamp: Time) -> PoseStamped:
    """A position (2,) [m] in the world frame."""
    return pose_message(np.array([*position, 0.0]), stamp)


def commanded_velocity(message: TwistStamped) -> Array:
    """Velocity (2,) [m/s] of the tip in the world frame."""
    return np.array([message.twist.linear.x, message.twist.linear.y])


def perturbation_message(applied: AppliedPerturbation, stamp: Time) -> PerturbationMessage:
    """An applied perturbation; `stamp` is its time."""
    message = PerturbationMessage(kind=int(applied.kind), magnitude=applied.magnitude)
    message.header.frame_id = FRAME
    message.header.stamp = stamp
    message.direction.x, message.direction.y = map(float, applied.direction)
    return message


class GroundTruthMessage:
    """Converts true states to one message that is filled in place."""

    def __init__(self, slider: Slider) -> None:
        """Allocates the message for a slider."""
        self._slider = slider
        self._message = GroundTruth()
        self._message.header.frame_id = FRAME

    def of(self, state: TrueState, stamp: Time) -> GroundTruth:
        """The message for a stamp; valid until the next call, which fills the same one."""
        message, pose, tip = self._message, state.object_pose, state.tip_position
        message.header.stamp = stamp
        message.pose[:] = pose
        message.tip[:] = tip
        message.p_y = self._slider.contact_offset(pose, tip)
        message.gap = self._slider.gap(pose, tip)
        return message
