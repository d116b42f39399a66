"""Conversion between messages and arrays."""

import math
from array import array
from dataclasses import replace
from pathlib import Path

import numpy as np
from geometry_msgs.msg import PoseStamped, TwistStamped
from push_core.geometry import Array, quaternion_to_yaw
from push_msgs.msg import ControllerState, NominalTrajectory
from push_msgs.msg import Lesson as LessonMessage
from push_msgs.srv import Predict
from push_node.stamps import to_stamp

from push_mpc.loop import Tick
from push_mpc.plan import Lesson, Plan
from push_mpc.settings import MpcSettings
from push_mpc.table import Query, QueryResult


def set_stamp(message: TwistStamped | ControllerState, stamp: int) -> None:
    """Writes a stamp [ns] into a message's header."""
    message.header.stamp = to_stamp(stamp)


def planar_pose(message: PoseStamped) -> Array:
    """Pose (3,) [x m, y m, theta rad] of a message."""
    position, turn = message.pose.position, message.pose.orientation
    return np.array([position.x, position.y, quaternion_to_yaw(turn.z, turn.w)])


def position(message: PoseStamped) -> Array:
    """Position (2,) [m] of a message."""
    return np.array([message.pose.position.x, message.pose.position.y])


def fill_command(message: TwistStamped, velocity: Array) -> None:
    """Writes a tip velocity (2,) [m/s] into a message."""
    message.twist.linear.x = float(velocity[0])
    message.twist.linear.y = float(velocity[1])


def fill_state(message: ControllerState, tick: Tick) -> None:
    """Writes the record of a tick into a message; the node adds stamp, number and timing."""
    unknown = (math.nan,) * 4
    message.mode = int(tick.mode)
    message.reference_time = tick.reference_time
    message.exposure, message.now = tick.exposure, tick.now
    message.state = unknown if tick.state is None else tick.state
    message.predicted = unknown if tick.predicted is None else tick.predicted
    message.reference = unknown if tick.reference is None else tick.reference
    message.gap = float(tick.gap)
    message.input = unknown[:2] if tick.input is None else tick.input
    message.nominal_input = unknown[:2] if tick.nominal_input is None else tick.nominal_input
    message.estimate = unknown[:3] if tick.estimate is None else tick.estimate
    message.innovation = unknown[:3] if tick.innovation is None else tick.innovation
    expected = tick.innovation_deviation
    message.innovation_deviation = unknown[:3] if expected is None else expected
    message.disturbance = unknown[:3] if tick.disturbance is None else tick.disturbance
    message.solve_ms = tick.solve_ms
    message.iterations = tick.iterations
    message.solver_status = tick.solver_status
    message.limited = tick.limited


def nominal_message(plan: Plan, settings: MpcSettings) -> NominalTrajectory:
    """The plan up to the end of the reference, without the overrun for the horizon."""
    time, state, inputs = plan.until_end()
    message = NominalTrajectory(
        track=Path(settings.track).stem,
        controller=settings.controller,
        speed=settings.speed,
        side=settings.slider.side,
        tip_radius=settings.slider.tip_radius,
        laps=settings.laps,
    )
    message.header.frame_id = 'world'
    message.time = time.tolist()
    message.x, message.y, message.theta, message.p_y = (column.tolist() for column in state.T)
    message.v_n, message.v_t = (column.tolist() for column in inputs.T)
    return message


def lesson_of(message: LessonMessage, settings: MpcSettings) -> Lesson:
    """What laps have taught; without the shift where that is of another reference."""
    slider = replace(
        settings.slider,
        friction_pusher=message.friction,
        support_radius=message.support_radius,
    )
    of_this = (message.track, message.speed) == (Path(settings.track).stem, settings.speed)
    shift = np.reshape(message.shift if of_this else [], (-1, 2))
    return Lesson(slider if message.pushes else None, shift)


def request_of(query: Query) -> Predict.Request:
    """The service request of a query."""
    return Predict.Request(
        p_y=_numbers(query.p_y),
        beta=_numbers(query.beta),
        want_variance=query.want_variance,
    )


def result_of(response: Predict.Response, distance: float) -> QueryResult:
    """The result in a service response, per metre of travel."""
    mean, jacobian = np.reshape(response.mean, (-1, 3)), np.reshape(response.jacobian, (-1, 3, 2))
    return QueryResult.of(mean, jacobian, np.reshape(response.variance, (-1, 3)), distance)


def _numbers(values: Array) -> 'array[float]':
    """Values as `array.array`, which a message takes without checking each number."""
    return array('d', np.ascontiguousarray(values, dtype=np.float64).tobytes())
