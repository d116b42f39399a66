import numpy as np
import pytest
from push_core.geometry.frames import rotation
from push_core.physics.motion_cone import MotionCone
from push_mpc.motion.contact_force import ContactForce
from push_mpc.motion.dynamics import rates


@pytest.fixture(scope='module')
def cases():
    generator = np.random.default_rng(2)
    state = generator.uniform([-1, -1, -4, -0.04], [1, 1, 4, 0.04], (50, 4))
    inputs = generator.uniform([0.05, -0.5, -0.05], [2.0, 0.5, 0.05], (50, 3))
    return state, inputs


def test_the_linearisation_is_that_of_central_differences(
    slider, cases, central_differences
) -> None:
    motion = ContactForce(slider)
    by_state, by_input = motion.linearised(*cases)
    scale = np.array([1.0, 1.0, 1.0, 0.03, 1.0, 1.0, 0.05])

    def rates_at(point):
        values = point * scale
        return motion.rates(values[None, :4], values[None, 4:])[0]

    for index, (state, inputs) in enumerate(zip(*cases, strict=True)):
        found = central_differences(rates_at, np.concatenate([state, inputs]) / scale, 1e-5)
        expected = np.hstack([by_state[index], by_input[index]]) * scale
        assert np.allclose(found, expected, rtol=1e-6, atol=1e-9)


def test_a_force_moves_the_object_as_the_motion_cone_does(slider) -> None:
    generator = np.random.default_rng(3)
    p_y = generator.uniform(-0.03, 0.03, 200)
    beta = generator.uniform(0.6, np.pi - 0.6, 200)
    velocity = 0.07 * np.stack([np.sin(beta), np.cos(beta)], axis=-1)
    state = np.column_stack([np.zeros((200, 3)), p_y])
    motion = ContactForce(slider)
    inputs = motion.of_velocity(p_y, velocity)
    expected = rates(MotionCone(slider), state, velocity, slider.tip_x)
    assert np.allclose(motion.rates(state, inputs), expected, rtol=0, atol=1e-12)
    assert 20 < np.count_nonzero(np.abs(inputs[:, 2]) > 1e-9) < 180, 'some stick, some slide'


def test_the_velocity_of_a_force_is_the_velocity_that_makes_it(slider) -> None:
    motion = ContactForce(slider)
    for p_y, velocity in ((0.0, [0.08, -0.04]), (0.02, [0.05, 0.1]), (-0.03, [0.02, -0.05])):
        inputs = motion.of_velocity(np.array([p_y]), np.array([velocity]))[0]
        assert motion.tip_velocity(p_y, inputs) == pytest.approx(velocity, abs=1e-15)


def test_where_it_sticks_the_contact_moves_with_the_tip(slider) -> None:
    """The pushed point's velocity, by finite differences of its place in the world."""
    motion, p_y, force = ContactForce(slider), 0.015, np.array([0.6, 0.05, 0.0])
    pose, brief = np.zeros(4), 1e-7
    pose[3] = p_y
    moved = pose + brief * motion.rates(pose[None], force[None])[0]
    place = np.array([slider.p_x, p_y])
    velocity = (moved[:2] + rotation(moved[2]) @ place - place) / brief
    assert motion.tip_velocity(p_y, force) == pytest.approx(velocity, abs=1e-6)


@pytest.mark.parametrize('velocity', [[0.0, 0.0], [0.0, 0.1], [-0.05, 0.1], [-0.05, -0.1]])
def test_a_tip_that_rests_or_leaves_has_an_input_as_well(slider, velocity) -> None:
    motion = ContactForce(slider)
    inputs = motion.input_of(0.02, *velocity)
    assert motion.tip_velocity(0.02, inputs) == pytest.approx(velocity, abs=1e-15)
