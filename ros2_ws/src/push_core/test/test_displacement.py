import math

import numpy as np
import pytest
from push_core.geometry.displacement import displacement_of, twist_of


@pytest.fixture
def twists() -> np.ndarray:
    generator = np.random.default_rng(1)
    return generator.uniform([0.002, -0.002, -0.12], [0.004, 0.002, 0.12], (50, 3))


def arc(twist: np.ndarray) -> np.ndarray:
    """Where a constant twist leads in unit time, by ten thousand small steps."""
    x, y, heading = 0.0, 0.0, 0.0
    for _ in range(10_000):
        middle = heading + 0.5e-4 * twist[2]
        x += 1e-4 * (math.cos(middle) * twist[0] - math.sin(middle) * twist[1])
        y += 1e-4 * (math.sin(middle) * twist[0] + math.cos(middle) * twist[1])
        heading += 1e-4 * twist[2]
    return np.array([x, y, heading])


def test_a_displacement_ends_where_the_twist_leads(twists) -> None:
    found, _ = displacement_of(twists, np.zeros((50, 3, 2)))
    for twist, displacement in zip(twists[:5], found, strict=False):
        expected = arc(twist)
        assert displacement == pytest.approx(expected, abs=3e-3 * np.hypot(*twist[:2]))
        assert np.hypot(*(twist - expected)[:2]) < 0.07 * np.hypot(*twist[:2])


def test_the_twist_behind_a_displacement_is_the_one_that_made_it(twists) -> None:
    again, _ = twist_of(*displacement_of(twists, np.zeros((50, 3, 2))))
    assert np.abs(again - twists).max() < 4e-3 * np.abs(twists).max(axis=0)[0]


@pytest.mark.parametrize('turned', [twist_of, displacement_of])
def test_the_derivatives_are_those_of_finite_differences(turned, twists) -> None:
    generator = np.random.default_rng(2)
    by = generator.normal(size=(50, 3, 2))
    _, found = turned(twists, by)
    for column in range(2):
        step = 1e-6 * by[:, :, column]
        change = turned(twists + step, by)[0] - turned(twists - step, by)[0]
        np.testing.assert_allclose(found[:, :, column], change / 2e-6, rtol=0, atol=1e-9)
