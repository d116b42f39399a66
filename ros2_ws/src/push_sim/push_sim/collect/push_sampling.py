"""Contact offset and direction of each collected push. A new sampling is a line in `SAMPLINGS`."""

import math
from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np
from push_core.common import InputError
from push_core.data import five_push_pattern

from push_sim.collect.push_design import PushDesign

Sampler: TypeAlias = Callable[[int, np.random.Generator], tuple[float, float]]
"""Maps the number of a push and its random generator to p_y [m] and beta [rad]."""

Sampling: TypeAlias = Callable[[PushDesign, float, int], Sampler]
"""Makes a sampler from the design, the side of the square [m] and the number of pushes."""


def uniform(design: PushDesign, side: float, _pushes: int) -> Sampler:
    """Uniform random over the face and the directions."""

    def sample(_number: int, random: np.random.Generator) -> tuple[float, float]:
        p_y = random.uniform(-1.0, 1.0) * design.face_part * side / 2.0
        return p_y, math.pi / 2.0 + random.uniform(-1.0, 1.0) * design.steepest

    return sample


def grid(design: PushDesign, side: float, pushes: int) -> Sampler:
    """Centres of k x k cells over the directions and over the part of the face that is safe.

    Raises:
        InputError: the number of pushes is not a square, or they are as long as half the face.
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
    centres = (np.arange(count) + 0.5) / count * 2.0 - 1.0

    def sample(number: int, _random: np.random.Generator) -> tuple[float, float]:
        row, column = divmod(number, count)
        return half * centres[row], math.pi / 2.0 + design.steepest * centres[column]

    return sample


def die(_design: PushDesign, side: float, _pushes: int) -> Sampler:
    """The five pushes of `push_core.data.five_of_a_die`, repeated."""
    inputs = five_push_pattern(side / 2.0)

    def sample(number: int, _random: np.random.Generator) -> tuple[float, float]:
        p_y, beta = inputs[number % len(inputs)].tolist()
        return p_y, beta

    return sample


SAMPLINGS: Mapping[str, Sampling] = {'uniform': uniform, 'grid': grid, 'die': die}
