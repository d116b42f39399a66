import math

import numpy as np
import pytest
from numpy.typing import NDArray
from push_core.frames import rotation
from push_core.slider import Slider
from push_sim.plant import Plant
from push_sim.settings import profile

POSE = np.array([0.1, -0.2, 0.3])


@pytest.fixture
def slider() -> Slider:
    return Slider()


@pytest.fixture
def start(slider: Slider) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """An object pose and a tip that touches it."""
    return POSE, slider.tip_position(POSE, 0.01)


@pytest.fixture
def weave():
    """World velocity (2,) of a push that weaves, at a number of periods."""

    def velocity(tick: int, speed: float = 0.08) -> NDArray[np.float64]:
        return rotation(POSE[2]) @ [speed, 0.02 * math.sin(0.1 * tick)]

    return velocity


@pytest.fixture
def ideal(slider: Slider) -> Plant:
    return Plant(profile('ideal'), slider)


@pytest.fixture
def irb120(slider: Slider) -> Plant:
    return Plant(profile('irb120'), slider)
