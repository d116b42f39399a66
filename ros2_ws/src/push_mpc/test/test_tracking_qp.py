"""The QP, against one that is built independently in SI units and solved by another solver."""

from types import SimpleNamespace

import numpy as np
import pytest
from push_mpc.qp.stages import NX, InputSpace, Stages
from push_mpc.qp.tracking_qp import OSQP_SETTINGS, TrackingQP
from push_sim.settings.plant_settings import PerturbationKind

NU = 2
ITERATION_LIMIT = 7  # a status of OSQP
SPACE = InputSpace(np.full(NU, 1e-2), np.eye(NU), np.full(NU, 1e-2))
STATE_WEIGHTS = np.array([6000.0, 6000.0, 1.0, 1000.0])
INPUT_WEIGHTS = np.array([10.0, 1.0])
CHANGE_WEIGHTS = np.array([2.0, 2.0])
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
    parts = {'transition': 0, 'effect': 1, 'drift': 2, 'target': 3}
    preview = SimpleNamespace(**{name: problem[index] for name, index in parts.items()})
    return Stages.of(SPACE, preview, problem[4])


def solved(problem, times=1, widening=0.0):
    qp = TrackingQP(len(problem[0]), SPACE, STATE_WEIGHTS, INPUT_WEIGHTS, CHANGE_WEIGHTS)
    made = stages_of(problem)
    for _ in range(times):
        qp.prepare(made, np.arange(6), made)
        solution = qp.solve(problem[5], widening, DISTURBANCE, BEFORE)
    return solution


def test_without_bounds_it_is_the_least_squares_solution(problem, unrolled) -> None:
    transition, effect, drift, target, _, start = problem
    free, forced = unrolled(transition, effect, drift @ [1.0, *DISTURBANCE], start)
    aim = target @ DISTURBANCE
    later = np.concatenate([aim[1:, :NX], aim[-1:, :NX]]).ravel()
    root = np.sqrt(np.tile(STATE_WEIGHTS, 6))
    change = np.sqrt(CHANGE_WEIGHTS)
    rows = np.vstack(
        [
            root[:, None] * forced,
            np.diag(np.sqrt(np.tile(INPUT_WEIGHTS, 6))),
            np.eye(NU, 6 * NU) * change[:, None],
        ]
    )
    preferred = np.sqrt(INPUT_WEIGHTS) * aim[:, NX:]
    right = np.concatenate([root * (later - free), preferred.ravel(), change * BEFORE])
    expected = np.linalg.lstsq(rows, right)[0].reshape(6, NU)
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


def test_a_problem_without_a_solution_is_not_usable_unless_its_bounds_are_opened(problem) -> None:
    far_off = np.full((6, 3), [0.5, 0.0, 0.0]), np.full((6, 3), [0.6, 0.0, 0.0])
    impossible = (*problem[:4], far_off, problem[5])
    assert not solved(impossible).usable
    assert solved(impossible, widening=0.6).usable


def test_stages_give_back_what_they_were_made_of(problem) -> None:
    again = stages_of(problem).in_si_units(np.array([3, 1]))
    given_parts = [*problem[:4], *problem[4]]
    for given, found in zip(given_parts, [*again[:4], *again[4]], strict=True):
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
