"""Support of the slider on the table: four feet on its diagonals and their static loads.

The friction moment of a pressure distribution is its friction force times c, the mean distance of
the pressure from the centre. Four feet at distance c have the friction moment of the distribution.
"""

import math

import numpy as np
from push_core.geometry import Array
from push_core.physics import Pair, uniform_pressure_radius

from push_sim.settings import WorldSettings

QUADRANTS = ((-1, -1), (-1, 1), (1, -1), (1, 1))
"""Signs of x and y of the feet, in their order."""


def pressure_radius(pressure: str, side: float) -> float:
    """Friction moment divided by friction force [m] of a pressure on a square.

    Args:
        pressure: `uniform`; `centred`, uniform on the inner square of half the side; `rim`, only
            on the four edges.
        side: side of the square [m].
    """
    if pressure == 'rim':
        return 1.5 * uniform_pressure_radius(side)
    return uniform_pressure_radius(side if pressure == 'uniform' else 0.5 * side)


def feet(settings: WorldSettings, side: float, seed: int) -> list[Pair]:
    """Positions [m] of the four feet under a square; the seed is used by pressure `random`.

    Args:
        settings: pressure and support radius.
        side: side of the square [m].
        seed: seed of the reset.
    """
    distances = _distances(settings, side, seed) / math.sqrt(2.0)
    return [(x * d, y * d) for (x, y), d in zip(QUADRANTS, distances.tolist(), strict=True)]


def _distances(settings: WorldSettings, side: float, seed: int) -> Array:
    if settings.pressure == 'calibrated':
        return np.full(4, settings.support_radius * (1.0 + settings.size_error))
    if settings.pressure == 'random':
        low, high = pressure_radius('centred', side), pressure_radius('rim', side)
        return np.random.default_rng(seed).uniform(low, high, 4)
    return np.full(4, pressure_radius(settings.pressure, side))


def loads(positions: list[Pair]) -> Array:
    """Fractions (4,) of the weight on feet that are equal springs under a rigid body."""
    plane = np.vstack([np.ones(len(positions)), np.array(positions).T])
    balance = np.array([1.0, 0.0, 0.0])
    return np.asarray(plane.T @ np.linalg.solve(plane @ plane.T, balance))


def friction_moment_radius(positions: list[Pair]) -> float:
    """Friction moment divided by friction force [m] of feet at these positions."""
    return float(loads(positions) @ [math.hypot(*position) for position in positions])
