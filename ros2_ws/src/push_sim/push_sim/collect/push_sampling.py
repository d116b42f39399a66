"""Where and in which direction each collected push sets out."""

import math
from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from push_core.common import InputError
from push_core.data import five_of_a_die

from push_sim.collect.push_design import PushDesign

Aim: TypeAlias = Callable[[int, np.random.Generator], tuple[float, float]]
"""From the number of a push and its random source to p_y [m] and beta [rad]."""

Sampling: TypeAlias = Callable[[PushDesign, float, int], Aim]
"""From the design, the side of the square [m] and the number of pushes to their aims."""


def uniform(design: PushDesign, side: float, _pushes: int) -> Aim:
    """Drawn evenly over face and directions."""

    def aim(_number: int, random: np.random.Generator) -> tuple[float, float]:
        p_y = random.uniform(-1.0, 1.0) * design.face_part * side / 2.0
        return p_y, math.pi / 2.0 + random.uniform(-1.0, 1.0) * design.steepest

    return aim


def grid(design: PushDesign, side: float, pushes: int) -> Aim:
    """The middles of k x k cells over the directions and over what of the face keeps the tip.

    Raises:
        InputError: the number of pushes is no square, or they are as long as half the face.
    """
    count = math.isqrt(pushes)
    if count * count != pushes:
        raise InputError(
            f'a grid takes a square number of pushes, {count**2} or {(count + 1) ** 2}, '
            f'not {pushes}'
        )
    half = min(design.face_part * side / 2.0, side / 2.0 - design.reach)
    if half <= 0.0:
        raise InputError(f'pushes of {design.reach:g} m leave the face: take a shorter --duration')
    middles = (np.arange(count) + 0.5) / count * 2.0 - 1.0

    def aim(number: int, _random: np.random.Generator) -> tuple[float, float]:
        row, column = divmod(number, count)
        return half * middles[row], math.pi / 2.0 + design.steepest * middles[column]

    return aim


def die(_design: PushDesign, side: float, _pushes: int) -> Aim:
    """The five of a die in turn: `push_core.data.die`."""
    places = five_of_a_die(side / 2.0)

    def aim(number: int, _random: np.random.Generator) -> tuple[float, float]:
        p_y, beta = places[number % len(places)].tolist()
        return p_y, beta

    return aim


SAMPLINGS: dict[str, Sampling] = {'uniform': uniform, 'grid': grid, 'die': die}
