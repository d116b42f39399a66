"""The horizon linearised along the last plan, against the nonlinear motion."""

from dataclasses import replace

import numpy as np
import pytest
from push_core.physics.motion_cone import MotionCone
from push_mpc.motion import ContactForce, Expansion, TravelMotion
from push_mpc.qp.last_plan import LastPlan
from push_mpc.qp.midpoint_rule import MidpointRule
from push_mpc.qp.steady_shift import steady_shift
from scipy.optimize import fsolve

STEPS, STEP = 20, 0.05
DISTURBANCE = np.array([0.02, -0.03, 0.6])
UNITS = np.array([1.0, 1.0, 1.0, 0.03])


class Case:
    """A motion along a plan, and a last plan beside it."""

    def __init__(self, motion, states, inputs) -> None:
        self.motion, self.states, self.inputs = motion, states, inputs
        generator = np.random.default_rng(4)
        self.last = LastPlan(STEPS, inputs.shape[1])
        self.last.states[:] = generator.normal(scale=[3e-3, 3e-3, 0.05, 3e-3], size=(21, 4))
        self.last.inputs[:] = 0.1 * generator.normal(size=inputs.shape) * np.abs(inputs).max()

    def linearised(self):
        rule = MidpointRule(STEPS, self.inputs.shape[1])
        nominal = self.states, self.inputs, np.zeros((STEPS, 4))
        rule.linearise(self.motion, nominal, self.last, STEP)
        return np.split(rule.dynamics, np.cumsum([4, self.inputs.shape[1], 1]), axis=-1)

    def rates(self, state, inputs, disturbance):
        moved = self.motion.rates(state[None], inputs[None])[0]
        return moved + self.motion.disturbed(state[None], inputs[None])[0] @ disturbance


@pytest.fixture(params=['travel', 'force'])
def case(request, eight, slider, model) -> Case:
    samples = 5 * np.arange(STEPS + 1) + 1000
    states, inputs = eight.state[samples].copy(), eight.input[samples[:-1]]
    states[:, 3] += 0.004
    if request.param == 'travel':
        return Case(TravelMotion(model, slider.tip_x), states, inputs)
    motion = ContactForce(slider)
    return Case(motion, states, motion.of_velocity(states[:-1, 3], inputs))


def test_the_expansion_is_the_rates_and_their_derivatives(case) -> None:
    states = case.states[:-1]
    found = Expansion(STEPS, case.inputs.shape[1])
    case.motion.expand(states, case.inputs, found)
    by_state, by_input = case.motion.linearised(states, case.inputs)
    expected = {
        'rates': case.motion.rates(states, case.inputs),
        'by_heading': by_state[:, :, 2],
        'by_contact': by_state[:, :, 3],
        'by_input': by_input,
        'by_twist': case.motion.disturbed(states, case.inputs),
    }
    for name, value in expected.items():
        assert np.allclose(getattr(found, name), value, rtol=1e-12, atol=1e-13), name


def test_a_sideways_response_scales_one_derivative_and_the_slip_that_follows(case) -> None:
    if not isinstance(case.motion, TravelMotion):
        pytest.skip('the response is that of the motion under a moving tip')
    motion, states = case.motion, case.states[:-1]
    level = np.column_stack([states[:, :2], np.zeros(STEPS), states[:, 3]])
    whole, turned = Expansion(STEPS, 2), Expansion(STEPS, 2)
    motion.expand(level, case.inputs, whole)
    replace(motion, sideways_response=-1.0).expand(level, case.inputs, turned)
    change = turned.by_input - whole.by_input
    sideways = whole.by_input[:, 1, 1]
    assert np.allclose(change[:, 1, 1], -2.0 * sideways)
    assert np.allclose(change[:, 3, 1], 2.0 * sideways)
    change[:, [1, 3], 1] = 0.0
    assert np.abs(change).max() < 1e-15
    assert np.array_equal(turned.rates, whole.rates)


def midpoint_step(case, start, inputs, disturbance):
    """The end of a step by the implicit midpoint rule, by an independent solver."""

    def defect(end):
        rates = case.rates(0.5 * (start + end), inputs, disturbance)
        return (end - start - STEP * rates) / UNITS

    # a tolerance near rounding, for which the solver would warn
    end, *_ = fsolve(defect, start, xtol=1e-13, full_output=True)
    assert np.abs(defect(end)).max() < 1e-12
    return end


def test_the_matrices_are_the_derivatives_of_a_step_along_the_last_plan(
    case, central_differences
) -> None:
    """Where the last plan obeys the equations of motion, A and B are those of the exact step."""
    states, inputs = case.states + case.last.states, case.inputs + case.last.inputs
    for index in range(STEPS):
        states[index + 1] = midpoint_step(case, states[index], inputs[index], np.zeros(3))
    case.last.states[:] = states - case.states
    transition, effect, drift, _ = case.linearised()
    scale = np.concatenate([UNITS, np.abs(inputs).max(axis=0)])
    for index in range(0, STEPS, 3):
        point = np.concatenate([states[index], inputs[index]]) / scale

        def end(values):
            values = values * scale
            return midpoint_step(case, values[:4], values[4:], np.zeros(3))

        expected = central_differences(end, point, 1e-4)
        found = np.hstack([transition[index], effect[index]]) * scale
        assert np.allclose(found, expected, rtol=0, atol=1e-5 * np.abs(expected).max())
        before, after = case.last.states[index : index + 2]
        predicted = transition[index] @ before + effect[index] @ case.last.inputs[index]
        assert predicted + drift[index, :, 0] == pytest.approx(after, abs=1e-10)


def test_repeated_it_finds_the_nonlinear_motion(case) -> None:
    """The states that follow from the last inputs, with a disturbance; Newton's method."""
    start = case.last.states[0].copy()
    for _ in range(6):
        transition, effect, drift, by_twist = case.linearised()
        case.last.states[0] = start
        for index in range(STEPS):
            case.last.states[index + 1] = (
                transition[index] @ case.last.states[index]
                + effect[index] @ case.last.inputs[index]
                + drift[index, :, 0]
                + by_twist[index] @ DISTURBANCE
            )
    state = case.states[0] + start
    for index in range(STEPS):
        inputs = case.inputs[index] + case.last.inputs[index]
        state = midpoint_step(case, state, inputs, DISTURBANCE)
        expected = case.states[index + 1] + case.last.states[index + 1]
        # the derivative by the heading leaves the disturbance out: linear convergence
        assert state == pytest.approx(expected, abs=1e-6)


def test_a_step_is_that_of_fine_steps_but_for_its_length_squared(eight, slider, model) -> None:
    motion = TravelMotion(model, slider.tip_x)
    case = Case(motion, eight.state[1000:1021], eight.input[1000:1020])
    state, inputs = case.states[0], case.inputs[0]
    fine = state.copy()
    for _ in range(1000):
        slope = case.rates(fine, inputs, np.zeros(3))
        fine = fine + STEP / 1000 * case.rates(fine + STEP / 2000 * slope, inputs, np.zeros(3))
    whole = midpoint_step(case, state, inputs, np.zeros(3))
    moved = np.abs(fine - state).max()
    assert np.abs((whole - fine) / UNITS).max() < 0.01 * moved


def test_under_a_constant_disturbance_the_shifted_plan_stays_on_its_path(eight, slider) -> None:
    """The rates of the motion with the disturbance, at the shifted state and input."""
    motion = TravelMotion(MotionCone(slider), slider.tip_x)
    disturbance = np.array([0.01, 0.02, 0.2])
    target = steady_shift(motion, eight) @ disturbance
    state, inputs = eight.state + target[:, :4], eight.input + target[:, 4:]
    added = motion.disturbed(eight.state, eight.input) @ disturbance
    planned = motion.rates(eight.state, eight.input)
    left = motion.rates(state, inputs) + motion.disturbed(state, inputs) @ disturbance - planned
    share = np.abs(left[200:900]).max(axis=0) / np.abs(added[200:900]).max(axis=0)
    # the contact sticks: it rolls on where the object turns otherwise
    assert (share[:3] < 0.05).all()


def test_a_model_that_knows_no_bounds_gives_finite_matrices(eight, slider) -> None:
    class Wild:
        def evaluate(self, p_y, beta):
            return np.full((len(p_y), 3), 1e3), np.full((len(p_y), 3, 2), -1e6)

    case = Case(TravelMotion(Wild(), slider.tip_x), eight.state[:21], eight.input[:20])
    assert all(np.isfinite(part).all() for part in case.linearised())
