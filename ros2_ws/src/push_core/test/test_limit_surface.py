import math

import numpy as np
import pytest
from push_core.physics.limit_surface import LimitSurface, uniform_pressure_radius


@pytest.fixture(scope='module')
def surface(slider) -> LimitSurface:
    return LimitSurface.of(slider)


def test_even_pressure_gives_the_mean_distance_from_the_centre() -> None:
    middles = (np.arange(1000) + 0.5) / 1000 - 0.5
    distances = np.hypot(middles[:, None], middles[None, :])
    assert uniform_pressure_radius(0.09) == pytest.approx(0.09 * distances.mean(), rel=1e-6)


def test_its_half_axes_are_the_largest_force_and_moment(surface, slider) -> None:
    weight = slider.mass * 9.81
    tips = np.diag([0.35 * weight, 0.35 * weight, 0.35 * weight * slider.support_radius])
    assert surface.value(tips) == pytest.approx([0.5, 0.5, 0.5])


def test_the_twist_is_normal_to_the_surface(surface) -> None:
    # along a curve on the surface, the wrench moves at right angles to the twist
    angle = np.linspace(0.0, 2.0 * math.pi, 50)
    axes = [surface.force, surface.force, surface.moment]
    curve = np.stack([np.cos(angle), 0.6 * np.sin(angle), 0.8 * np.sin(angle)], axis=-1) * axes
    along = np.stack([-np.sin(angle), 0.6 * np.cos(angle), 0.8 * np.cos(angle)], axis=-1) * axes
    assert surface.value(curve) == pytest.approx(np.full(50, 0.5))
    assert np.sum(surface.twist(curve) * along, axis=-1) == pytest.approx(np.zeros(50), abs=1e-12)


def test_friction_takes_the_most_power_from_its_own_twist(surface) -> None:
    # maximum dissipation: of all wrenches on the surface, the one with this twist resists it most
    generator = np.random.default_rng(1)
    wrenches = generator.normal(size=(500, 3)) * surface.weights**-0.5
    wrenches /= np.sqrt(2.0 * surface.value(wrenches))[:, None]
    power = wrenches @ surface.twist(wrenches).T
    assert np.array_equal(np.argmax(power, axis=0), np.arange(500))
