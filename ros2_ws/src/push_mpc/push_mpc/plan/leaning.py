"""A plan that agrees with a model, also where its support radius is not the planned one."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from push_core.geometry import Array
from push_core.physics import Slider

from push_mpc.motion import Motion
from push_mpc.plan.consistent_plan import consistent_plan
from push_mpc.plan.nominal import Plan

_SAME = 0.05  # change of the support radius that needs no other guess
_LEARNED_CHANGE = 1.5  # of a plan with an identified model, see `consistent_plan`


def agreeing_plan(
    plan: Plan, motion: Motion, planned: Slider, known: Slider | None
) -> Plan | None:
    """The plan that agrees with a model's motion, None if none is found.

    Args:
        plan: made for the planned slider.
        motion: of the model, under tip velocities.
        planned: slider of the plan.
        known: slider as it has been identified; None before it is.
    """
    if known is None:
        return consistent_plan(plan, motion)
    found = (
        consistent_plan(guess, motion, _LEARNED_CHANGE) for guess in guesses(plan, planned, known)
    )
    return next((each for each in found if each is not None), None)


def guesses(plan: Plan, planned: Slider, known: Slider) -> Iterator[Plan]:
    """Plans from which a consistent one may be found, best first.

    The side-slip of the flat plan grows with the square of the support radius. Half-way between
    the planned and the known one the iteration has converged most often.

    Args:
        plan: made for the planned slider.
        planned: slider of the plan.
        known: slider as it has been identified.
    """
    ratio = known.support_radius / planned.support_radius
    if abs(math.log(ratio)) > _SAME:
        for factor in (ratio, ratio**2):
            yield _leaning(plan, planned.p_x, factor)
    yield plan


def _leaning(plan: Plan, p_x: float, factor: float) -> Plan:
    """The plan with its side-slip multiplied by a factor, in contact at p_y = 0."""
    x, y, heading, _ = plan.state.T
    speed = np.hypot(np.gradient(x, plan.period), np.gradient(y, plan.period))
    direction = _continuous(np.arctan2(np.gradient(y), np.gradient(x)), heading)
    slip = factor * (direction - heading)
    turned = direction - slip
    rate = np.gradient(turned, plan.period)
    inputs = np.stack([speed * np.cos(slip), speed * np.sin(slip) + p_x * rate], axis=-1)
    return replace(plan, state=np.stack([x, y, turned, np.zeros_like(x)], axis=-1), input=inputs)


def _continuous(direction: Array, heading: Array) -> Array:
    """Directions [rad] without jumps, in the same turn as the first heading."""
    unwrapped = np.unwrap(direction)
    turns = np.round((heading[0] - unwrapped[0]) / (2.0 * math.pi))
    return np.asarray(unwrapped + 2.0 * math.pi * turns)
