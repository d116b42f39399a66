"""How the slider presses on the table: four feet on its diagonals, loaded as the statics say.

The friction moment of a load is its force times c, the mean distance of the pressure from the
centre. Feet at that distance have the friction moment of a pressure that is spread out.
"""

import math

import numpy as np
from push_core.geometry import Array
from push_core.physics import Pair, uniform_pressure_radius

from push_sim.settings import WorldSettings

QUADRANTS = ((-1, -1), (-1, 1), (1, -1), (1, 1))
"""Signs of x and y of the feet, in their order."""


def pressure_radius(pressure: str, side: float) -> float:
    """Friction moment over friction force [m] of a pressure on a square of a side [m].

    Args:
        pressure: `uniform`; `centred`, uniform on the inner square of half the side; `rim`, on
            the four edges alone.
        side: of the square.
    """
    if pressure == 'rim':
        return 1.5 * uniform_pressure_radius(side)
    return uniform_pressure_radius(side if pressure == 'uniform' else 0.5 * side)


def feet(settings: WorldSettings, side: float, seed: int) -> list[Pair]:
    """Places [m] of the four feet under a square of a side [m]; `random` ones by the seed."""
    distances = _distances(settings, side, seed) / math.sqrt(2.0)
    return [(x * d, y * d) for (x, y), d in zip(QUADRANTS, distances.tolist(), strict=True)]


def _distances(settings: WorldSettings, side: float, seed: int) -> Array:
    if settings.pressure == 'calibrated':
        return np.full(4, settings.support_radius * (1.0 + settings.size_error))
    if settings.pressure == 'random':
        low, high = pressure_radius('centred', side), pressure_radius('rim', side)
        return np.random.default_rng(seed).uniform(low, high, 4)
    return np.full(4, pressure_radius(settings.pressure, side))


def loads(places: list[Pair]) -> Array:
    """Parts (4,) of the weight on feet that are equal springs: a plane's heights, in balance."""
    plane = np.vstack([np.ones(len(places)), np.array(places).T])
    balance = np.array([1.0, 0.0, 0.0])
    return np.asarray(plane.T @ np.linalg.solve(plane @ plane.T, balance))


def friction_moment_radius(places: list[Pair]) -> float:
    """Friction moment over friction force [m] of feet at these places."""
    return float(loads(places) @ [math.hypot(*place) for place in places])
