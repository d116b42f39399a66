"""The quadratic program, against one built anew in SI units and solved by another solver."""

import numpy as np
import pytest
from push_mpc.tracking_qp import NU, NX, TrackingQP
from push_sim.perturbation import Kind
from scipy import sparse

clarabel = pytest.importorskip('clarabel', reason='clarabel is in requirements/dev.txt')

STATE_WEIGHTS = np.array([6000.0, 6000.0, 1.0, 30.0])
INPUT_WEIGHTS = np.array([10.0, 1.0])


def independent_inputs(transition, effect, drift, start, contact_bounds, input_bounds):
    """Optimal input deviations (N, 2) [m/s], states eliminated, by an interior-point method."""
    free, forced = unrolled(transition, effect, drift, start)
    steps = len(transition)
    weights = np.tile(STATE_WEIGHTS, steps)
    hessian = 2.0 * (forced.T * weights @ forced + np.diag(np.tile(INPUT_WEIGHTS, steps)))
    gradient = 2.0 * forced.T @ (weights * free)
    rows = np.vstack([forced[3::NX], np.eye(NU * steps)])
    shift = np.concatenate([free[3::NX], np.zeros(NU * steps)])
    low = np.concatenate([contact_bounds[0], input_bounds[0].ravel()]) - shift
    high = np.concatenate([contact_bounds[1], input_bounds[1].ravel()]) - shift
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    solver = clarabel.DefaultSolver(
        sparse.triu(hessian, format='csc'),
        gradient,
        sparse.csc_matrix(np.vstack([rows, -rows])),
        np.concatenate([high, -low]),
        [clarabel.NonnegativeConeT(2 * len(rows))],
        settings,
    )
    solution = solver.solve()
    assert solution.status == clarabel.SolverStatus.Solved
    return np.reshape(solution.x, (steps, NU))


def unrolled(transition, effect, drift, start):
    """States after the first (4 N,) without input deviations, and by them (4 N, 2 N)."""
    steps = len(transition)
    free, forced = np.zeros((steps, NX)), np.zeros((steps, NX, steps, NU))
    state, by_input = start, np.zeros((NX, steps, NU))
    for index in range(steps):
        state = transition[index] @ state + drift[index]
        by_input = np.tensordot(transition[index], by_input, axes=1)
        by_input[:, index] += effect[index]
        free[index], forced[index] = state, by_input
    return free.ravel(), forced.reshape(NX * steps, NU * steps)


@pytest.fixture
def recorded(tracking, monkeypatch):
    """The problems of 250 ticks with kicks, and the solutions that the controller had."""
    problems, solutions = [], []
    update, solve = TrackingQP.update, TrackingQP.solve

    def keep_problem(self, *problem):
        problems.append(problem)
        update(self, *(np.copy(part) for part in problem))

    def keep_solution(self):
        solutions.append(solve(self))
        return solutions[-1]

    monkeypatch.setattr(TrackingQP, 'update', keep_problem)
    monkeypatch.setattr(TrackingQP, 'solve', keep_solution)
    kicks = {30: (Kind.TANGENTIAL, 0.02), 100: (Kind.NORMAL, 0.02), 170: (Kind.TANGENTIAL, -0.02)}
    for tick in range(250):
        if tick in kicks:
            tracking.disturb(*kicks[tick])
        tracking.tick()
    return problems, solutions


def test_every_first_input_is_that_of_the_other_solver_to_1e_4(recorded) -> None:
    problems, solutions = recorded
    at_a_bound = 0
    for problem, solution in list(zip(problems, solutions, strict=True))[::4]:
        expected = independent_inputs(*problem)
        assert np.abs(solution.inputs[0] - expected[0]).max() < 1e-4
        low, high = problem[5]
        at_a_bound += np.any((expected < low + 1e-6) | (expected > high - 1e-6))
    assert at_a_bound >= 3, 'the kicks were too weak to test the bounds'


def test_the_solver_is_warm_and_its_iterations_are_few(recorded) -> None:
    _, solutions = recorded
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
    c = 1e-4 * generator.normal(size=(6, NX))
    start = np.array([2e-3, -1e-3, 0.02, 1e-3])
    wide = np.ones(6), np.ones((6, NU))
    return a, b, c, start, (-wide[0], wide[0]), (-wide[1], wide[1])


def solved(problem, times=1):
    qp = TrackingQP(len(problem[0]), STATE_WEIGHTS, INPUT_WEIGHTS)
    for _ in range(times):
        qp.update(*problem)
        solution = qp.solve()
    return solution


def test_without_bounds_it_is_the_least_squares_solution(problem) -> None:
    free, forced = unrolled(*problem[:4])
    root = np.sqrt(np.tile(STATE_WEIGHTS, 6))
    rows = np.vstack([root[:, None] * forced, np.diag(np.sqrt(np.tile(INPUT_WEIGHTS, 6)))])
    right = np.concatenate([-root * free, np.zeros(12)])
    expected = np.linalg.lstsq(rows, right)[0].reshape(6, NU)
    assert np.allclose(solved(problem).inputs, expected, rtol=0, atol=1e-6)


def test_inputs_stay_within_their_bounds(problem) -> None:
    free_inputs = solved(problem).inputs
    half = 0.5 * np.abs(free_inputs).max()
    bounds = np.full((6, NU), -half), np.full((6, NU), half)
    inputs = solved((*problem[:5], bounds)).inputs
    assert np.abs(inputs).max() == pytest.approx(half, abs=1e-6)


def test_solving_again_starts_from_the_solution(problem) -> None:
    assert solved(problem, times=2).iterations <= solved(problem).iterations
    assert np.allclose(solved(problem, times=2).inputs, solved(problem).inputs, atol=1e-6)


def test_a_problem_without_a_solution_is_not_usable(problem) -> None:
    a, b, c, start, _, inputs = problem
    far_off = np.full(6, 0.5), np.full(6, 0.6)
    still = np.zeros((6, NU)), np.zeros((6, NU))
    assert not solved((a, b, c, start, far_off, still)).usable
    assert solved((a, b, c, start, problem[4], inputs)).usable
