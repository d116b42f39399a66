"""The friction of the pusher and the support radius with which the world is nearest to the pushes.

The misfit is a normalised mean squared error: displacements along and across the push and turns,
each over its variance; short pushes and long ones count the same.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from push_core.common import replaced
from push_core.data import LongPushes, PushSet, in_push_frame
from push_core.geometry import Array
from scipy.optimize import least_squares

from push_sim.fitting.bootstrap import bootstrap_deviation
from push_sim.measured import Replay
from push_sim.settings import WorldSettings

FITTED = ('friction_pusher', 'support_radius')
_STEP = 0.04
_STIFFER = 3.0


@dataclass(frozen=True)
class Pushes:
    """What the world is fitted to: short pushes and long ones that stay on the face."""

    short: PushSet | None
    long: LongPushes | None


@dataclass(frozen=True)
class WorldFit:
    """What was found.

    Attributes:
        settings: the world with the parameters `FITTED` replaced.
        deviation: (2,) standard deviations of those.
        misfit: of the fitted world.
        stiffness_effect: the most that a foot three times as stiff or as soft changes the misfit.
        misfit_deviation: standard deviation of the misfit by the choice of the pushes.
    """

    settings: WorldSettings
    deviation: Array
    misfit: float
    stiffness_effect: float
    misfit_deviation: float


def fitted_world(replay: Replay, pushes: Pushes, start: WorldSettings, seed: int) -> WorldFit:
    """Least squares over the logarithms of the parameters.

    Args:
        replay: makes the pushes again.
        pushes: as measured.
        start: where the search begins.
        seed: of the draws of the bootstrap.
    """

    def residual(logarithms: Array) -> Array:
        return _residual(replay, pushes, _with_values(start, np.exp(logarithms))).ravel()

    first = np.log([getattr(start, name) for name in FITTED])
    found = least_squares(residual, first, diff_step=_STEP / np.abs(first), xtol=2e-3, ftol=1e-4)
    settings = _with_values(start, np.exp(found.x))
    rows = found.fun.reshape(-1, 3)
    relative = bootstrap_deviation(rows, found.jac.reshape(-1, 3, 2), seed)
    each = np.sum(rows**2, axis=1)
    return WorldFit(
        settings,
        np.exp(found.x) * relative,
        float(each.sum()),
        _stiffness_effect(replay, pushes, settings, float(each.sum())),
        float(each.std() * math.sqrt(each.size)),
    )


def _with_values(settings: WorldSettings, values: Array) -> WorldSettings:
    return replaced(settings, dict(zip(FITTED, values.tolist(), strict=True)))


def _stiffness_effect(
    replay: Replay, pushes: Pushes, settings: WorldSettings, misfit: float
) -> float:
    """How much the misfit changes with feet three times as stiff, or as soft, at the most."""
    others = (settings.stiffness * _STIFFER, settings.stiffness / _STIFFER)
    changed = (
        float(np.sum(_residual(replay, pushes, replace(settings, stiffness=other)) ** 2))
        for other in others
    )
    return max(abs(value - misfit) for value in changed)


def _residual(replay: Replay, pushes: Pushes, world: WorldSettings) -> Array:
    """(n, 3) errors in the frame of each push; the sum of their squares is the misfit."""
    parts = []
    if pushes.short:
        short = pushes.short
        error = replay.short(world, short) - short.displacement
        parts.append(_scaled(error, short.displacement, short.beta))
    if pushes.long:
        long = pushes.long
        error = _motion(long.end, replay.long(world, long))
        moved = _motion(long.start, long.end)
        parts.append(_scaled(error, moved, math.pi / 2.0 - long.direction))
    return np.concatenate(parts) / math.sqrt(len(parts))


def _motion(start: Array, end: Array) -> Array:
    """(n, 3) from one pose to the other, the turn within half a revolution."""
    motion = end - start
    motion[:, 2] = np.remainder(motion[:, 2] + math.pi, math.tau) - math.pi
    return np.asarray(motion)


def _scaled(error: Array, moved: Array, beta: Array) -> Array:
    """Errors (n, 3) by the spread of the motion (n, 3), such that their squares sum up to an NMSE.

    Args:
        error: in the frame in which `beta` is an angle to the y axis.
        moved: in the same frame.
        beta: (n,) directions of the pushes [rad].
    """
    spread = in_push_frame(moved, beta).std(axis=0)
    return np.asarray(in_push_frame(error, beta) / (spread * math.sqrt(error.size)))
