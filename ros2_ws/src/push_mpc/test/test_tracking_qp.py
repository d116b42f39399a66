"""The QP, against one that is built independently in SI units and solved by another solver."""

import numpy as np
import pytest
from push_mpc.qp.solver import OSQP_SETTINGS
from push_mpc.qp.stages import NX, InputSpace, Stages
from push_mpc.qp.tracking_qp import QPWeights, TrackingQP
from push_sim.settings.plant_settings import PerturbationKind
from scipy.optimize import linprog

NU = 2
ITERATION_LIMIT = 7  # a status of OSQP
SPACE = InputSpace(np.full(NU, 1e-2), np.eye(NU), np.full(NU, 1e-2), ('v_n [m/s]', 'v_t [m/s]'))
STATE_WEIGHTS = np.array([6000.0, 6000.0, 1.0, 1000.0])
INPUT_WEIGHTS = np.array([10.0, 1.0])
CHANGE_WEIGHTS = np.array([2.0, 2.0]), np.array([0.0, 0.0])
WEIGHTS = QPWeights(STATE_WEIGHTS, INPUT_WEIGHTS, *CHANGE_WEIGHTS)
BEFORE = np.array([0.01, -0.02])
DISTURBANCE = np.array([0.1, -0.2, 3.0])


@pytest.fixture
def recorded(tracking, recorded_problems):
    """The problems of 250 ticks with kicks, and the solutions that the controller had."""
    kicks = {
        30: (PerturbationKind.TANGENTIAL, 0.02),
        100: (PerturbationKind.NORMAL, 0.02),
        170: (PerturbationKind.TANGENTIAL, -0.02),
    }
    for tick in range(250):
        if tick in kicks:
            tracking.disturb(*kicks[tick])
        tracking.tick()
    return recorded_problems


def test_every_first_input_is_that_of_the_other_solver_to_1e_4(
    recorded, independent_inputs
) -> None:
    at_a_bound = 0
    for problem, solution in recorded[::4]:
        expected = independent_inputs(
            STATE_WEIGHTS, INPUT_WEIGHTS, CHANGE_WEIGHTS, np.eye(NU), *problem
        )
        assert np.abs(solution.inputs[0] - expected[0]).max() < 1e-4
        low, high = (limit[:, 1:] for limit in problem[4])
        at_a_bound += np.any((expected < low + 1e-6) | (expected > high - 1e-6))
    assert at_a_bound >= 3, 'the kicks were too weak to test the bounds'


def test_the_solver_is_warm_and_its_iterations_are_few(recorded) -> None:
    solutions = [solution for _, solution in recorded]
    assert {solution.status for solution in solutions} == {1}
    assert np.median([solution.iterations for solution in solutions]) <= 25


@pytest.fixture
def problem():
    """A random problem of 6 steps whose bounds do not bind."""
    generator = np.random.default_rng(1)
    a = np.tile(np.eye(NX), (6, 1, 1))
    a[:, :2, 2:] = generator.normal(scale=0.02, size=(6, 2, 2))
    a[:, 2, 3] = generator.normal(scale=0.5, size=6)
    b = 0.03 * generator.normal(size=(6, NX, NU)) * [[1], [1], [10], [1]]
    c = 1e-4 * generator.normal(size=(6, NX, 4))
    target = 1e-3 * generator.normal(size=(6, NX + NU, 3))
    start = np.array([2e-3, -1e-3, 0.02, 1e-3])
    return a, b, c, target, (-np.ones((6, 3)), np.ones((6, 3))), start


def stages_of(problem):
    return Stages.of(SPACE, problem[3], problem[4])


def dynamics_of(problem):
    return np.concatenate(problem[:3], axis=-1)


def solved(problem, times=1, widening=0.0):
    qp = TrackingQP(len(problem[0]), SPACE, WEIGHTS)
    made = stages_of(problem)
    for _ in range(times):
        qp.prepare(made, np.arange(6), made, dynamics_of(problem))
        solution = qp.solve(problem[5], widening, DISTURBANCE, BEFORE)
    return solution


def test_without_bounds_it_is_the_least_squares_solution(problem, unrolled) -> None:
    transition, effect, drift, target, _, start = problem
    free, forced = unrolled(transition, effect, drift @ [1.0, *DISTURBANCE], start)
    aim = target @ DISTURBANCE
    later = np.concatenate([aim[1:, :NX], aim[-1:, :NX]]).ravel()
    root = np.sqrt(np.tile(STATE_WEIGHTS, 6))
    change, smooth = (np.sqrt(weights) for weights in CHANGE_WEIGHTS)
    rows = np.vstack(
        [
            root[:, None] * forced,
            np.diag(np.sqrt(np.tile(INPUT_WEIGHTS, 6))),
            np.eye(NU, 6 * NU) * change[:, None],
            np.kron(np.diff(np.eye(6), axis=0), np.diag(smooth)),
        ]
    )
    preferred = np.sqrt(INPUT_WEIGHTS) * aim[:, NX:]
    unchanged = np.zeros(5 * NU)
    right = [root * (later - free), preferred.ravel(), change * BEFORE, unchanged]
    expected = np.linalg.lstsq(rows, np.concatenate(right), rcond=None)[0].reshape(6, NU)
    assert np.allclose(solved(problem).inputs, expected, rtol=0, atol=1e-6)


def test_inputs_stay_within_their_bounds(problem) -> None:
    free_inputs = solved(problem).inputs
    half = 0.5 * np.abs(free_inputs).max()
    limit = np.full((6, 3), [1.0, half, half])
    inputs = solved((*problem[:4], (-limit, limit), problem[5])).inputs
    # the solver's own tolerance, absolute and relative, at five of its units of 1 cm/s
    tolerance = (5e-5 + 5.0 * 5e-5) * 1e-2
    assert np.abs(inputs).max() == pytest.approx(half, abs=tolerance)


def test_solving_again_starts_from_the_solution(problem) -> None:
    assert solved(problem, times=2).iterations <= solved(problem).iterations
    assert np.allclose(solved(problem, times=2).inputs, solved(problem).inputs, atol=1e-6)


def test_changed_weights_count_as_if_the_solver_had_been_made_with_them(
    problem, impossible
) -> None:
    state, none = np.array([6000.0, 0.0, 1.0, 10.0]), np.zeros(2)
    light = QPWeights(state, np.array([1.0, 3.0]), none, none)
    for each in (problem, impossible):
        made = stages_of(each)
        fresh, changed = TrackingQP(6, SPACE, light), TrackingQP(6, SPACE, WEIGHTS)
        for qp in (fresh, changed):
            qp.prepare(made, np.arange(6), made, dynamics_of(each))
        changed.solve(each[5], 0.0, DISTURBANCE, BEFORE)
        changed.weigh(light)
        changed.forget()
        first, second = (
            qp.solve(each[5], 0.0, DISTURBANCE, BEFORE).inputs.copy() for qp in (fresh, changed)
        )
        assert np.array_equal(first, second)
        assert not np.allclose(second, solved(each).inputs, atol=1e-3)


@pytest.fixture
def impossible(problem):
    """The same problem with p_y bounded to where no input brings it."""
    far_off = np.full((6, 3), [0.02, -0.1, -0.1]), np.full((6, 3), [0.03, 0.1, 0.1])
    return (*problem[:4], far_off, problem[5])


def least_violation(problem, unrolled) -> tuple[np.ndarray, float]:
    """Sum of the violations of the bounds on p_y [m] of the inputs, and the least possible."""
    transition, effect, drift, _, (low, high), start = problem
    free, forced = unrolled(transition, effect, drift @ [1.0, *DISTURBANCE], start)
    contact, rows = free[3::NX], forced[3::NX]
    steps, count = rows.shape
    found = linprog(
        np.concatenate([np.zeros(count), np.ones(steps)]),
        A_ub=np.block([[rows, -np.eye(steps)], [-rows, -np.eye(steps)]]),
        b_ub=np.concatenate([high[:, 0] - contact, contact - low[:, 0]]),
        bounds=[*zip(low[:, 1:].ravel(), high[:, 1:].ravel(), strict=True), *[(0, None)] * steps],
    )
    reached = contact + rows @ solved(problem).inputs.ravel()
    violation = np.maximum(low[:, 0] - reached, reached - high[:, 0]).clip(min=0.0).sum()
    return violation, found.fun


def test_bounds_on_p_y_that_cannot_be_kept_are_violated_as_little_as_possible(
    impossible, unrolled
) -> None:
    violation, least = least_violation(impossible, unrolled)
    assert least > 1e-3, 'the bounds can be kept'
    assert solved(impossible).usable
    assert violation == pytest.approx(least, abs=2e-5)


def test_inputs_keep_their_bounds_where_p_y_cannot(impossible) -> None:
    assert np.abs(solved(impossible).inputs).max() <= 0.1 + 1e-4


def test_opened_bounds_need_no_violation(impossible) -> None:
    assert solved(impossible, widening=0.1).iterations < solved(impossible).iterations


def test_where_the_bounds_can_be_kept_the_relaxed_problem_has_the_same_solution(
    recorded, tracking
) -> None:
    (qp,) = tracking.controller._tracker.steering.solvers
    exact = qp.problem
    first = slice(exact.states, exact.states + NU)
    qp._relaxed.solve(exact.matrix.data, exact.linear, exact.low, exact.high)
    relaxed = qp._relaxed.solve(exact.matrix.data, exact.linear, exact.low, exact.high)
    assert relaxed.info.status_val == 1
    # hundredths of the solver's unit of 1 cm/s
    assert np.allclose(relaxed.x[first], recorded[-1][1].inputs[0] / SPACE.scale, atol=2e-2)
    assert np.allclose(relaxed.x[exact.linear.size :], 0.0, atol=1e-3)


def test_a_solution_that_is_refused_names_the_constraint_that_it_violates_most(
    impossible, monkeypatch
) -> None:
    monkeypatch.setitem(OSQP_SETTINGS, 'max_iter', 5)
    qp = TrackingQP(6, SPACE, WEIGHTS)
    made = stages_of(impossible)
    qp.prepare(made, np.arange(6), made, dynamics_of(impossible))
    assert not qp.solve(impossible[5], 0.0, DISTURBANCE, BEFORE).usable
    qp._variables[:] = 0.0
    qp._low[:28] = qp._high[:28] = 0.0
    qp._variables[28 + 2 * NU] = 15.0
    assert qp.largest_violation() == (
        'v_n [m/s] in step 3 of 6 is violated by 0.05, p_y is 0.02 m beyond its bounds'
    )
    qp._variables[0] = np.nan
    assert qp.largest_violation() == 'its solution is not a number'


def test_stages_give_back_what_they_were_made_of(problem) -> None:
    again = stages_of(problem).in_si_units(np.array([3, 1]))
    for given, found in zip([problem[3], *problem[4]], [again[0], *again[1]], strict=True):
        np.testing.assert_allclose(found, given[[3, 1]], rtol=1e-14, atol=1e-18)


@pytest.fixture
def interrupted(problem, monkeypatch):
    """The solution, with bounds that bind, after so many iterations of a solver never content."""
    half = 0.5 * np.abs(solved(problem).inputs).max()
    limit = np.full((6, 3), [1.0, half, half])
    bounded = (*problem[:4], (-limit, limit), problem[5])

    def solve(iterations: int):
        for name, value in (('eps_abs', 1e-15), ('eps_rel', 1e-15), ('max_iter', iterations)):
            monkeypatch.setitem(OSQP_SETTINGS, name, value)
        return solved(bounded)

    return solve


def test_at_the_iteration_limit_a_solution_that_keeps_its_constraints_is_usable(
    interrupted,
) -> None:
    nearly = interrupted(40)
    assert (nearly.status, nearly.usable) == (ITERATION_LIMIT, True)
    assert nearly.residual < 1e-3


def test_at_the_iteration_limit_a_solution_that_breaks_its_constraints_is_refused(
    interrupted,
) -> None:
    far_off = interrupted(5)
    assert (far_off.status, far_off.usable) == (ITERATION_LIMIT, False)
    assert far_off.residual > 0.1
