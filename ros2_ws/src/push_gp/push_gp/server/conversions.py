"""Conversion between messages and arrays."""

from array import array
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
from builtin_interfaces.msg import Time
from push_core.common import InputError
from push_core.data import PushSet
from push_core.geometry import Array
from push_core.physics import Slider
from push_msgs.msg import AddedPushes, Lesson, NominalTrajectory
from push_msgs.msg import ModelInfo as ModelInfoMessage
from push_msgs.srv import AddPushes, Predict

from push_gp.learn import Identified, Learned, TimedReference
from push_gp.models import ModelInfo, SmoothCone


def model_info_message(info: ModelInfo, stamp: Time) -> ModelInfoMessage:
    """Description of a model, stamped with the time at which it was loaded or extended."""
    message = ModelInfoMessage(
        model_id=info.model_id,
        model_hash=info.model_hash,
        kind=info.kind,
        mean_function=info.mean_function,
        points=info.points,
        training_set_hash=info.training_set_hash,
        distance=info.distance,
        p_y_domain=np.array(info.p_y_domain),
        beta_domain=np.array(info.beta_domain),
        lengthscales=info.lengthscales.ravel(),
        signal_std=info.signal_std,
        noise_std=info.noise_std,
    )
    message.header.stamp = stamp
    return message


def reference_of(message: NominalTrajectory) -> TimedReference:
    """The reference of a plan that was announced."""
    return TimedReference(
        message.track,
        message.speed,
        message.laps,
        _vector(message.time),
        np.column_stack((_vector(message.x), _vector(message.y))),
        message.theta[0],
    )


def lesson_message(learned: Learned, taught: tuple[int, int], base: str, stamp: Time) -> Lesson:
    """What laps and pieces have taught.

    Args:
        learned: the lesson.
        taught: number of laps and of pieces that did.
        base: id of the model before anything was taught.
        stamp: when it was learned.
    """
    slider, known = learned.identified.model.slider, learned.identified
    message = Lesson(
        laps=taught[0],
        pieces=taught[1],
        lesson_id=learned.lesson_id(base),
        model_id=learned.model.info.model_id if learned.model else base,
        pushes=known.pushes,
        friction=slider.friction_pusher,
        support_radius=slider.support_radius,
        covariance=known.covariance.ravel(),
        track=learned.track,
        speed=learned.speed,
        shift=flat(learned.shift),
    )
    message.header.stamp = stamp
    return message


def learned_of(message: Lesson, nominal: Slider, distance: float) -> Learned:
    """What a message tells; the geometry is that of the nominal slider."""
    slider = replace(
        nominal, friction_pusher=message.friction, support_radius=message.support_radius
    )
    covariance = _vector(message.covariance).reshape(2, 2)
    known = Identified(SmoothCone(slider, distance), covariance, message.pushes)
    shift = _vector(message.shift).reshape(-1, 2)
    return Learned(known, message.track, message.speed, shift)


def queries_of(request: Predict.Request) -> tuple[Array, Array]:
    """(n,) contact offsets [m] and (n,) push directions [rad] of a request."""
    return _vector(request.p_y), _vector(request.beta)


def added_pushes_message(pushes: PushSet, model_id: str, stamp: Time) -> AddedPushes:
    """Pushes that were added, and the model that resulted, stamped with the time of the change."""
    message = AddedPushes(
        model_id=model_id,
        p_y=flat(pushes.p_y),
        beta=flat(pushes.beta),
        displacement=flat(pushes.displacement),
        distance=pushes.distance,
    )
    message.header.stamp = stamp
    return message


def pushes_of(request: AddPushes.Request | AddedPushes) -> PushSet:
    """The pushes of a request, or of an announcement of added pushes.

    Raises:
        InputError: the lengths do not match, or a value is out of range.
    """
    displacement = _vector(request.displacement)
    if displacement.size != 3 * len(request.p_y) or len(request.beta) != len(request.p_y):
        raise InputError(
            f'{len(request.p_y)} p_y, {len(request.beta)} beta and {displacement.size} '
            'displacement values: the last must be three for each push'
        )
    p_y, beta = _vector(request.p_y), _vector(request.beta)
    return PushSet(p_y, beta, displacement.reshape(-1, 3), request.distance)


def flat(values: Array) -> 'array[float]':
    """Row-major numbers as the array type that a message accepts without a Python loop."""
    return array('d', np.ascontiguousarray(values, dtype=np.float64).tobytes())


def _vector(values: Iterable[float] | Any) -> Array:
    return np.array(values, dtype=np.float64)
