import numpy as np
import pytest
from push_core.motion_cone import MotionCone
from push_mpc.dynamics import TravelMotion, rates
from push_mpc.preview import Preview

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
            + preview.drift[sample]
        )
        found = state - eight.state[sample + STRIDE]
        # the step is of first order in its three samples
    assert np.allclose(found, predicted, rtol=0, atol=[1e-6, 1e-6, 1.2e-5, 1e-6])


def test_a_plan_that_fits_its_model_has_no_drift(eight, slider) -> None:
    # a point contact, for which the plan was made; a circle's samples are 3e-8 m off its tangent
    motion = TravelMotion(MotionCone(slider), slider.p_x)
    drift = Preview.of(eight, motion, STRIDE).drift
    assert np.abs(drift[200:900]).max() < 1e-7


def test_a_round_tip_rolls_along_the_face(eight, slider, preview) -> None:
    omega = np.gradient(eight.state[:, 2], eight.period)
    rolled = STRIDE * eight.period * omega * slider.tip_radius
    assert np.allclose(preview.drift[200:900, 3], rolled[200:900], rtol=0, atol=1e-7)
