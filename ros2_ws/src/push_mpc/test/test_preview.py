import numpy as np
import pytest
from push_core.physics.motion_cone import MotionCone
from push_mpc.motion.dynamics import TravelMotion, rates
from push_mpc.qp.preview import Preview

STRIDE = 3


@pytest.fixture(scope='module')
def preview(eight, slider) -> Preview:
    return Preview.of(eight, TravelMotion(MotionCone(slider), slider.tip_x), STRIDE)


def test_it_predicts_a_perturbed_motion_about_the_plan(eight, slider, preview) -> None:
    """One horizon step of the nonlinear model in fine steps, beside the plan all along."""
    state_error = np.array([1e-4, -1e-4, 2e-4, 2e-5])
    input_error = np.array([1e-4, -1e-4])
    fine = eight.period / 100
    for sample in (100, 700, 1500):
        state = eight.state[sample] + state_error
        for index in range(100 * STRIDE):
            inputs = eight.at(eight.time[sample] + index * fine)[1] + input_error
            moved = rates(MotionCone(slider), state[None], inputs[None], slider.tip_x)[0]
            state = state + fine * moved
        predicted = (
            preview.transition[sample] @ state_error
            + preview.effect[sample] @ input_error
            + preview.drift[sample, :, 0]
        )
        found = state - eight.state[sample + STRIDE]
        # the step is of first order in its three samples
    assert np.allclose(found, predicted, rtol=0, atol=[1e-6, 1e-6, 1.2e-5, 1e-6])


def test_a_plan_that_fits_its_model_has_no_drift(eight, slider) -> None:
    # a point contact, for which the plan was made; a circle's samples are 3e-8 m off its tangent
    motion = TravelMotion(MotionCone(slider), slider.p_x)
    drift = Preview.of(eight, motion, STRIDE).drift
    assert np.abs(drift[200:900, :, 0]).max() < 1e-7


def test_a_motion_that_is_known_better_replaces_that_of_the_derivatives(eight, slider) -> None:
    motion = TravelMotion(MotionCone(slider), slider.tip_x)
    own = np.gradient(eight.state, eight.period, axis=0)
    known = Preview.of(eight, motion, STRIDE, rates=own)
    assert np.abs(known.drift[:, :, 0]).max() < 1e-12
    assert np.array_equal(known.transition, Preview.of(eight, motion, STRIDE).transition)


def test_a_round_tip_rolls_along_the_face(eight, slider, preview) -> None:
    omega = np.gradient(eight.state[:, 2], eight.period)
    rolled = STRIDE * eight.period * omega * slider.tip_radius
    assert np.allclose(preview.drift[200:900, 3, 0], rolled[200:900], rtol=0, atol=1e-7)


def test_under_a_constant_disturbance_the_shifted_plan_stays_on_its_path(eight, slider) -> None:
    """The rates of the motion with the disturbance, at the shifted state and input."""
    motion = TravelMotion(MotionCone(slider), slider.tip_x)
    disturbance = np.array([0.01, 0.02, 0.2])
    target = Preview.of(eight, motion, STRIDE).target @ disturbance
    state, inputs = eight.state + target[:, :4], eight.input + target[:, 4:]
    added = motion.disturbed(eight.state, eight.input) @ disturbance
    planned = motion.rates(eight.state, eight.input)
    left = motion.rates(state, inputs) + motion.disturbed(state, inputs) @ disturbance - planned
    share = np.abs(left[200:900]).max(axis=0) / np.abs(added[200:900]).max(axis=0)
    # the contact sticks: it rolls on where the object turns otherwise
    assert (share[:3] < 0.05).all()
