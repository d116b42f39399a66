"""The square of the cell, its motion cone, and derivatives to compare with."""

from collections.abc import Callable

import numpy as np
import pytest
from push_core.frames import Array
from push_core.motion_cone import MotionCone
from push_core.slider import Slider

Differences = Callable[[Callable[[Array], Array], Array, float], Array]


@pytest.fixture(scope='session')
def slider() -> Slider:
    return Slider()


@pytest.fixture(scope='session')
def cone(slider: Slider) -> MotionCone:
    return MotionCone(slider)


@pytest.fixture(scope='session')
def central_differences() -> Differences:
    """Derivative of a vector function by each of its arguments, along a new last axis."""

    def derivative(function: Callable[[Array], Array], point: Array, step: float) -> Array:
        steps = step * np.eye(len(point))
        changes = [function(point + one) - function(point - one) for one in steps]
        return np.stack(changes, axis=-1) / (2.0 * step)

    return derivative
