"""Messages to arrays: the only place that knows the fields of the recorded messages."""

from typing import Any

import numpy as np
from push_core.errors import InputError
from push_core.quaternion import quaternion_to_yaw
from push_node.stamps import to_nanoseconds

from push_bag.series import Disturbance, Model, Reference


def nanoseconds(message: Any) -> int:
    """The stamp of a message's header [ns]."""
    return to_nanoseconds(message.header.stamp)


def planar_pose(message: Any) -> tuple[float, ...]:
    """X [m], y [m] and heading [rad] of a PoseStamped that is turned about z only."""
    position, turn = message.pose.position, message.pose.orientation
    return position.x, position.y, quaternion_to_yaw(turn.z, turn.w)


def position(message: Any) -> tuple[float, ...]:
    """X and y [m] of a PoseStamped."""
    return message.pose.position.x, message.pose.position.y


def velocity(message: Any) -> tuple[float, ...]:
    """v_x and v_y [m/s] of a TwistStamped."""
    return message.twist.linear.x, message.twist.linear.y


def tick(message: Any) -> tuple[float, ...]:
    """The STATE_COLUMNS of a ControllerState."""
    return (
        message.mode,
        message.reference_time,
        message.state[3],
        *message.input,
        *message.nominal_input,
        message.solve_ms,
        message.tick_ms,
        message.iterations,
        message.solver_status,
        message.limited,
    )


def reference(message: Any) -> Reference:
    """The reference of a NominalTrajectory.

    Raises:
        InputError: its arrays are empty or of different lengths.
    """
    arrays = [message.time, message.x, message.y, message.theta, message.p_y]
    arrays += [message.v_n, message.v_t]
    if len(message.time) < 2 or len({len(array) for array in arrays}) != 1:
        raise InputError('the recorded nominal trajectory is not a series of samples')
    time, x, y, theta, p_y, v_n, v_t = (np.asarray(array, np.float64) for array in arrays)
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


def model(message: Any) -> Model:
    """The model of a ModelInfo."""
    return Model(message.points, message.model_hash, message.kind)


def disturbance(message: Any) -> Disturbance:
    """The disturbance of a Perturbation."""
    return Disturbance(nanoseconds(message), message.kind, message.magnitude)
