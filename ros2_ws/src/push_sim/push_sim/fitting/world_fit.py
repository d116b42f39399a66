"""Fits the friction of the pusher and the support radius of a world to measured pushes.

The misfit is a normalised mean squared error in the frame of each push: displacements along and
across the push and rotations, each divided by its variance. Short and long pushes weigh the same.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from push_core.common import replaced
from push_core.data import LongPushes, PushSet, in_push_frame
from push_core.geometry import Array, wrap_angles
from scipy.optimize import least_squares

from push_sim.fitting.bootstrap import bootstrap_deviation
from push_sim.measured import Replay
from push_sim.settings import WorldSettings

FITTED = ('friction_pusher', 'support_radius')
"""Fitted parameters of `WorldSettings`."""

_STEP = 0.04
_STIFFNESS_FACTOR = 3.0


@dataclass(frozen=True)
class PushesToFit:
    """Short pushes, and the long ones that stay on the face; None if there are none."""

    short: PushSet | None
    long: LongPushes | None


@dataclass(frozen=True)
class WorldFit:
    """A fitted world.

    Attributes:
        settings: the world with the parameters `FITTED` replaced.
        deviation: (2,) their standard deviations.
        misfit: misfit of the fitted world.
        stiffness_effect: largest change of the misfit with feet three times as stiff or as soft.
        misfit_deviation: standard deviation of the misfit over the choice of the pushes.
    """

    settings: WorldSettings
    deviation: Array
    misfit: float
    stiffness_effect: float
    misfit_deviation: float


def fit_world(replay: Replay, pushes: PushesToFit, start: WorldSettings, seed: int) -> WorldFit:
    """Minimises the misfit over the logarithms of the parameters.

    Args:
        replay: simulates the pushes.
        pushes: measured pushes.
        start: initial guess.
        seed: seed of the bootstrap.
    """

    def residual(logarithms: Array) -> Array:
        return _residual(replay, pushes, _with_values(start, np.exp(logarithms))).ravel()

    first = np.log([getattr(start, name) for name in FITTED])
    result = least_squares(residual, first, diff_step=_STEP / np.abs(first), xtol=2e-3, ftol=1e-4)
    settings = _with_values(start, np.exp(result.x))
    rows = result.fun.reshape(-1, 3)
    relative = bootstrap_deviation(rows, result.jac.reshape(-1, 3, 2), seed)
    squared = np.sum(rows**2, axis=1)
    return WorldFit(
        settings,
        np.exp(result.x) * relative,
        float(squared.sum()),
        _stiffness_effect(replay, pushes, settings, float(squared.sum())),
        float(squared.std() * math.sqrt(squared.size)),
    )


def _with_values(settings: WorldSettings, values: Array) -> WorldSettings:
    return replaced(settings, dict(zip(FITTED, values.tolist(), strict=True)))


def _stiffness_effect(
    replay: Replay, pushes: PushesToFit, settings: WorldSettings, misfit: float
) -> float:
    """Largest change of the misfit with feet three times as stiff or as soft."""
    others = (settings.stiffness * _STIFFNESS_FACTOR, settings.stiffness / _STIFFNESS_FACTOR)
    changed = (
        float(np.sum(_residual(replay, pushes, replace(settings, stiffness=other)) ** 2))
        for other in others
    )
    return max(abs(value - misfit) for value in changed)


def _residual(replay: Replay, pushes: PushesToFit, world: WorldSettings) -> Array:
    """(n, 3) errors in the frame of each push; the sum of their squares is the misfit."""
    parts = []
    if pushes.short:
        short = pushes.short
        error = replay.short(world, short) - short.displacement
        parts.append(_normalised(error, short.displacement, short.beta))
    if pushes.long:
        long = pushes.long
        error = _motion(long.end, replay.long(world, long))
        moved = _motion(long.start, long.end)
        parts.append(_normalised(error, moved, math.pi / 2.0 - long.direction))
    return np.concatenate(parts) / math.sqrt(len(parts))


def _motion(start: Array, end: Array) -> Array:
    """(n, 3) difference of poses in the world frame [m, m, rad], the angle wrapped."""
    motion = end - start
    motion[:, 2] = wrap_angles(motion[:, 2])
    return np.asarray(motion)


def _normalised(error: Array, moved: Array, beta: Array) -> Array:
    """Errors (n, 3) in the push frame, scaled so that their squares sum up to an NMSE.

    Args:
        error: (n, 3) in the frame in which `beta` is an angle to the y axis.
        moved: (n, 3) measured motion in the same frame.
        beta: (n,) directions of the pushes [rad].
    """
    spread = in_push_frame(moved, beta).std(axis=0)
    return np.asarray(in_push_frame(error, beta) / (spread * math.sqrt(error.size)))
