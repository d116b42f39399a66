"""The square, its plan and table, and a plant with the controller that pushes in it."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from push_core.geometry.frames import Array
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider
from push_core.tracks.built_in import by_name
from push_mpc.loop.controller import Controller, Mode, Tick
from push_mpc.plan.nominal import Plan, flat_plan
from push_mpc.plan.planning import planned
from push_mpc.qp.stages import Stages
from push_mpc.qp.tracking_qp import Solution, TrackingQP
from push_mpc.settings.node_settings import MpcSettings, mpc_settings
from push_mpc.table.surrogate import Grid, Table
from push_sim.plant.perturbation import Perturbation
from push_sim.plant.plant import Plant
from push_sim.settings.plant_settings import PerturbationKind
from push_sim.settings.profiles import profile
from scipy import sparse

Differences = Callable[[Callable[[Array], Array], Array, float], Array]


class SmoothModel:
    """Displacement rates with closed derivatives that bend in both inputs."""

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        a, b = 30.0 * np.asarray(p_y), np.asarray(beta)
        mean = np.stack([np.sin(b) * np.cos(a), np.cos(b + a), np.sin(2.0 * b) * a], axis=-1)
        by_a = np.stack([-np.sin(b) * np.sin(a), -np.sin(b + a), np.sin(2.0 * b)], axis=-1)
        by_b = np.stack(
            [np.cos(b) * np.cos(a), -np.sin(b + a), 2.0 * np.cos(2.0 * b) * a], axis=-1
        )
        return mean, np.stack([30.0 * by_a, by_b], axis=-1)


@cache
def _plan_of(settings: MpcSettings) -> Plan:
    """The plan of some settings; cells only read it."""
    return planned(settings)


class Cell:
    """Plant and controller in one loop, without DDS."""

    def __init__(self, settings: MpcSettings, table: Table) -> None:
        self.plant = Plant(profile('irb120'), settings.slider)
        self.controller = Controller(settings, settings.slider, _plan_of(settings))
        self.controller.use(self.controller.prepare_model(table, 'table'))
        self.reset()

    def reset(self) -> None:
        """Puts the object at the start of the plan."""
        self.controller.stop('the plant is reset')
        while self.controller.mode == Mode.STOPPING:
            self.controller.hold(self.plant.time - Plant.START)
        self.controller.resume()
        start = self.controller.plan.state[0]
        tip = self.controller.settings.slider.tip_position(start[:3], start[3])
        self.seen = self.plant.reset(start[:3], tip, seed=1)

    def tick(self, object_pose: Array | None = None) -> Tick:
        """One period, with the measured pose or another one."""
        pose = self.seen.object_pose if object_pose is None else object_pose
        exposure, now = self.seen.time - Plant.START, self.plant.time - Plant.START
        tick = self.controller.step(pose, self.seen.tip_position, exposure, now)
        self.plant.command(tick.velocity, self.plant.time)
        self.seen = self.plant.step()
        return tick

    def disturb(self, kind: PerturbationKind, magnitude: float) -> None:
        self.plant.perturb(Perturbation(kind, magnitude))


@pytest.fixture(scope='session')
def slider() -> Slider:
    return Slider()


@pytest.fixture(scope='session')
def model() -> SmoothModel:
    return SmoothModel()


@pytest.fixture(scope='session')
def eight(slider: Slider) -> Plan:
    return flat_plan(by_name('eight'), 0.08, slider, laps=1, period=0.01, overrun=1.0)


@pytest.fixture(scope='session')
def plan_of() -> Callable[[MpcSettings], Plan]:
    """Plans, and knows the plan that a cell of the same settings has."""
    return _plan_of


@pytest.fixture(scope='session')
def tabulated() -> Callable[..., Table]:
    """Makes the table of a model."""

    def tabulate(model: object, p_y_points: int = 37, beta_points: int = 61) -> Table:
        grid = Grid(
            np.linspace(-0.045, 0.045, p_y_points), np.linspace(0.15, np.pi - 0.15, beta_points)
        )
        return Table(grid, *model.evaluate(*grid.points()))

    return tabulate


@pytest.fixture(scope='session')
def table(tabulated: Callable[..., Table]) -> Table:
    """The motion cone with the friction that the simulator has."""
    return tabulated(MotionCone(Slider(friction_pusher=0.23)))


@pytest.fixture
def make_cell(table: Table) -> Iterator[Callable[[MpcSettings], Cell]]:
    """Makes a cell with some settings and frees its plant afterwards."""
    made = []

    def make(settings: MpcSettings) -> Cell:
        made.append(Cell(settings, table))
        return made[-1]

    yield make
    for cell in made:
        cell.plant.close()


@pytest.fixture
def cell(make_cell: Callable[[MpcSettings], Cell]) -> Cell:
    """An armed cell on the 8-track."""
    made = make_cell(replace(mpc_settings('irb120'), good_poses=3, consistent_plan=False))
    made.controller.arm()
    return made


@pytest.fixture
def tracking(cell: Cell) -> Cell:
    """A cell that has been tracking for half a second."""
    for _ in range(54):
        cell.tick()
    assert cell.controller.mode == Mode.TRACKING
    return cell


@pytest.fixture(scope='session')
def central_differences() -> Differences:
    """Derivative of a vector function by each of its arguments, along a new last axis."""

    def derivative(function: Callable[[Array], Array], point: Array, step: float) -> Array:
        steps = step * np.eye(len(point))
        changes = [function(point + one) - function(point - one) for one in steps]
        return np.stack(changes, axis=-1) / (2.0 * step)

    return derivative


@pytest.fixture(scope='session')
def unrolled() -> Callable[..., tuple[Array, Array]]:
    """States after the first (4 N,) without input deviations, and by them (4 N, m N)."""

    def unroll(
        transition: Array, effect: Array, drift: Array, start: Array
    ) -> tuple[Array, Array]:
        steps, nx, nu = effect.shape
        free, forced = np.zeros((steps, nx)), np.zeros((steps, nx, steps, nu))
        state, by_input = start, np.zeros((nx, steps, nu))
        for index in range(steps):
            state = transition[index] @ state + drift[index]
            by_input = np.tensordot(transition[index], by_input, axes=1)
            by_input[:, index] += effect[index]
            free[index], forced[index] = state, by_input
        return free.ravel(), forced.reshape(nx * steps, nu * steps)

    return unroll


@pytest.fixture
def recorded_problems(monkeypatch: pytest.MonkeyPatch) -> list[tuple[tuple[Any, ...], Solution]]:
    """Collects the problems (in SI units) that every `TrackingQP` solves, and the solutions."""
    problems: list[tuple[tuple[Any, ...], Solution]] = []
    prepared: dict[TrackingQP, tuple[Any, ...]] = {}
    prepare, solve = TrackingQP.prepare, TrackingQP.solve

    def keep_problem(
        self: TrackingQP, stages: Stages, window: Array, first: Stages, dynamics: Array
    ) -> None:
        target, limits = stages.in_si_units(window)
        for limit, own in zip(limits, first.in_si_units(window[:1])[-1], strict=True):
            limit[0] = own[0]
        parts = np.split(dynamics.copy(), [4, dynamics.shape[-1] - 4], axis=-1)
        prepared[self] = (*parts, target, limits)
        prepare(self, stages, window, first, dynamics)

    def keep_solution(
        self: TrackingQP, start: Array, widening: float, disturbance: Array, before: Array
    ) -> Solution:
        solution = solve(self, start, widening, disturbance, before)
        solution = replace(solution, inputs=solution.inputs.copy())
        a, b, drift, target, limits = prepared[self]
        under = drift @ [1.0, *disturbance], target @ disturbance
        problems.append(((a, b, *under, limits, start.copy(), widening, before), solution))
        return solution

    monkeypatch.setattr(TrackingQP, 'prepare', keep_problem)
    monkeypatch.setattr(TrackingQP, 'solve', keep_solution)
    return problems


@pytest.fixture(scope='session')
def independent_inputs(unrolled: Callable[..., tuple[Array, Array]]) -> Callable[..., Array]:
    """Optimal input deviations (N, m), states eliminated, by an interior-point method.

    The target (N, 4 + m) is that of the state before each step and of the input in it.
    """
    clarabel = pytest.importorskip('clarabel', reason='clarabel is in requirements/dev.txt')

    def solve(
        state_weights: Array,
        input_weights: Array,
        change_weights: tuple[Array, Array],
        limited: Array,
        transition: Array,
        effect: Array,
        drift: Array,
        target: Array,
        limits: tuple[Array, Array],
        start: Array,
        widening: float,
        before: Array,
    ) -> Array:
        free, forced = unrolled(transition, effect, drift, start)
        steps, nx, nu = effect.shape
        aim = np.concatenate([target[1:, :nx], target[-1:, :nx]]).ravel()
        unit = np.sqrt(np.tile(input_weights, steps))
        weights = np.tile(state_weights, steps)
        forced /= unit
        hessian = 2.0 * (forced.T * weights @ forced + np.eye(nu * steps))
        gradient = 2.0 * (forced.T @ (weights * (free - aim)) - unit * target[:, nx:].ravel())
        first, later = change_weights
        hessian[:nu, :nu] += 2.0 * np.diag(first / input_weights)
        gradient[:nu] -= 2.0 * first * before / unit[:nu]
        changes = np.kron(np.diff(np.eye(steps), axis=0), np.diag(np.sqrt(later / input_weights)))
        hessian += 2.0 * changes.T @ changes
        rows = np.vstack([forced[3::nx], np.kron(np.eye(steps), limited) / unit])
        shift = np.concatenate([free[3::nx], np.zeros(len(limited) * steps)])
        low, high = (
            np.concatenate([limit[:, 0], limit[:, 1:].ravel()]) - shift for limit in limits
        )
        low[:steps] -= widening
        high[:steps] += widening
        sides = np.vstack([rows, -rows]), np.concatenate([high, -low])
        bounded = np.isfinite(sides[1])
        settings = clarabel.DefaultSettings()
        settings.verbose = False
        solution = clarabel.DefaultSolver(
            sparse.triu(hessian, format='csc'),
            gradient,
            sparse.csc_matrix(sides[0][bounded]),
            sides[1][bounded],
            [clarabel.NonnegativeConeT(int(bounded.sum()))],
            settings,
        ).solve()
        assert solution.status == clarabel.SolverStatus.Solved
        return np.reshape(solution.x / unit, (steps, nu))

    return solve
