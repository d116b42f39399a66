import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from push_core.physics.limit_surface import LimitSurface
from push_core.physics.motion_cone import ContactMode, MotionCone, contact_jacobian
from push_core.physics.slider import Slider

MODES = list(ContactMode)
P_Y = st.floats(-0.045, 0.045)
BETA = st.floats(1e-3, math.pi - 1e-3)


@pytest.fixture(scope='module')
def pushes(cone):
    """Pushes all over the face, and the contact mode of each."""
    p_y, beta = np.meshgrid(np.linspace(-0.045, 0.045, 19), np.linspace(0.05, 3.09, 61))
    return p_y.ravel(), beta.ravel(), cone.mode(p_y.ravel(), beta.ravel())


def at_contact(p_x, p_y, twist):
    """Velocity (n, 2) of the object's contact points."""
    return np.stack([contact_jacobian(p_x, y) @ t for y, t in zip(p_y, twist, strict=True)])


def unit_push(beta):
    return np.stack([np.sin(beta), np.cos(beta)], axis=-1)


def one(cone, p_y, beta):
    mean, jacobian = cone.evaluate(np.array([p_y]), np.array([beta]))
    return mean[0], jacobian[0]


def test_a_push_along_the_normal_through_the_centre_moves_straight_on(cone) -> None:
    mean, _ = one(cone, 0.0, math.pi / 2.0)
    assert mean == pytest.approx([1.0, 0.0, 0.0], abs=1e-15)


def test_every_mode_occurs_with_steep_pushes_to_the_left_sliding_left(cone, pushes) -> None:
    assert set(pushes[2]) == {-1.0, 0.0, 1.0}
    assert cone.mode(np.zeros(3), np.array([0.1, 1.57, 3.04])) == pytest.approx([1.0, 0.0, -1.0])


def test_a_sticking_contact_moves_with_the_pusher(cone, pushes) -> None:
    p_y, beta, mode = pushes
    sticks = mode == ContactMode.STICKING
    twist, _ = cone.evaluate(p_y[sticks], beta[sticks])
    moved = at_contact(cone.slider.p_x, p_y[sticks], twist)
    assert np.allclose(moved, unit_push(beta[sticks]), rtol=0, atol=1e-14)


def test_a_sticking_force_stays_inside_the_friction_cone(cone, pushes) -> None:
    p_y, beta, mode = pushes
    sticks = mode == ContactMode.STICKING
    normal, tangential = cone.force_of_velocity(p_y[sticks], beta[sticks]).T
    assert np.all(np.abs(tangential) <= cone.slider.friction_pusher * normal * (1.0 + 1e-12))


@pytest.mark.parametrize('mode', [ContactMode.SLIDING_LEFT, ContactMode.SLIDING_RIGHT])
def test_a_sliding_contact_keeps_the_normal_velocity_and_slips_to_its_side(
    cone, pushes, mode
) -> None:
    p_y, beta, modes = (values[pushes[2] == mode] for values in pushes)
    twist, _ = cone.evaluate(p_y, beta)
    slip = unit_push(beta) - at_contact(cone.slider.p_x, p_y, twist)
    assert np.allclose(slip[:, 0], 0.0, atol=1e-14)
    assert np.all(slip[:, 1] * modes > 0.0)


@pytest.mark.parametrize('mode', [ContactMode.SLIDING_LEFT, ContactMode.SLIDING_RIGHT])
def test_a_sliding_force_lies_on_the_edge_of_the_friction_cone(cone, pushes, mode) -> None:
    p_y, beta, _ = (values[pushes[2] == mode] for values in pushes)
    normal, tangential = cone.force_of_velocity(p_y, beta).T
    assert np.all(normal > 0.0)
    assert np.allclose(tangential, mode * cone.slider.friction_pusher * normal, rtol=1e-14)


def test_velocity_form_and_force_form_agree_on_the_limit_surface(cone, pushes) -> None:
    """The force of the velocity form, taken to the limit surface, gives the same twist."""
    p_y, beta, _ = pushes
    force = cone.force_of_velocity(p_y, beta)
    wrench = np.stack(
        [f @ contact_jacobian(cone.slider.p_x, y) for f, y in zip(force, p_y, strict=True)]
    )
    surface = LimitSurface.of(cone.slider)
    direction = surface.twist(wrench)
    twist, _ = cone.evaluate(p_y, beta)
    assert np.allclose(direction * surface.force**2, twist, rtol=1e-12, atol=1e-14)


@given(P_Y, BETA)
def test_a_mirrored_push_has_the_mirrored_motion(p_y, beta) -> None:
    cone = MotionCone(Slider())
    mean, _ = one(cone, p_y, beta)
    mirrored, _ = one(cone, -p_y, math.pi - beta)
    assert np.allclose(mirrored, mean * [1.0, -1.0, -1.0], rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize('mode', MODES)
def test_the_jacobian_is_that_of_central_differences(cone, pushes, mode) -> None:
    points = np.stack(pushes[:2], axis=-1)[pushes[2] == mode]
    steps = 1e-5 * np.array([0.05, 1.0])  # both inputs in their own size
    corners = points[:, None] + steps * [[1, 1], [1, -1], [-1, 1], [-1, -1]]
    # the derivative jumps at the edge between two modes
    points = points[np.all(cone.mode(*np.moveaxis(corners, -1, 0)) == mode, axis=1)]
    assert len(points) > 100
    expected = np.stack(
        [
            cone.evaluate(*(points + step).T)[0] - cone.evaluate(*(points - step).T)[0]
            for step in np.diag(steps)
        ],
        axis=-1,
    )
    _, jacobian = cone.evaluate(*points.T)
    largest = np.abs(expected).max(axis=(1, 2), keepdims=True)
    assert np.all(np.abs(2.0 * steps * jacobian - expected) <= 1e-6 * largest)


def test_the_motion_is_continuous_across_the_edges_of_the_cone(cone) -> None:
    p_y = np.repeat(np.linspace(-0.045, 0.045, 19), 20001)
    beta = np.tile(np.linspace(0.05, 3.09, 20001), 19)
    mean, _ = cone.evaluate(p_y, beta)
    jumps = np.abs(np.diff(mean.reshape(19, -1, 3), axis=1)).max(axis=(0, 1))
    assert np.all(jumps < [1e-3, 1e-3, 2e-2])


@given(P_Y, BETA, st.floats(0.0, 2.0))
@example(-0.045, 2.97, 2.0)  # an edge of the cone leans backwards
def test_no_push_pulls_the_object_or_gives_anything_but_numbers(p_y, beta, friction) -> None:
    cone = MotionCone(replace(Slider(), friction_pusher=friction))
    mean, jacobian = one(cone, p_y, beta)
    assert np.isfinite(mean).all()
    assert np.isfinite(jacobian).all()
    moved = contact_jacobian(cone.slider.p_x, p_y) @ mean
    assert moved[0] == pytest.approx(math.sin(beta), abs=1e-9)
    assert mean[0] >= 0.0
    normal, tangential = cone.force_of_velocity(np.array([p_y]), np.array([beta]))[0]
    assert abs(tangential) <= friction * normal + 1e-9
