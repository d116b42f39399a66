"""A nominal trajectory that obeys the model's own equations of motion.

The flat plan is exact for a sticking point contact. A round tip rolls, friction is limited, and a
learned model differs from both, so that along the flat plan its motion drifts off. This plan obeys
the model's equations of motion (midpoint rule) and follows the path as closely as they allow:
Gauss-Newton steps on the whole trajectory at once, each a banded linear system. It runs once per
model, outside the loop.
"""

from dataclasses import dataclass, replace

import numpy as np
from push_core.geometry import Array
from scipy.linalg import LinAlgError, solve_banded

from push_mpc.motion import Motion
from push_mpc.plan.nominal import Plan

_STEP = 0.001  # [m]; smallest length of an interval
_ITERATIONS = 40
_SHORTEST = 1e-3  # smallest share of a Gauss-Newton step
_DONE = 1e-3  # relative decrease of the merit that ends the iteration
_SLACK = 2e-6  # [m], [rad]; largest accepted defect (error of the equations of motion)
_DEFECT_PRICE = 1e3
LARGEST_CHANGE = 0.5
"""Largest change of [v_n, v_t] / speed from the guess."""

_DAMPING = 1e-5  # of a change of [v_n, v_t] / speed

NX, NU = 4, 2
_STAGE = NX + NX + NU
_STATE, _INPUT = slice(NX, 2 * NX), slice(2 * NX, _STAGE)
_REACH = _STAGE  # half bandwidth: an input couples to the next one
# for each metre of path: position [1/m^2], angle between face normal and path [1/rad^2],
# p_y [1/m^2]; and the change of [v_n, v_t] / speed for each metre [m^2]
_STATE_WEIGHTS = np.array([1e7, 1e7, 1.0, 300.0])
_CHANGE_WEIGHT = 0.02


@dataclass(frozen=True)
class _Trajectory:
    """States (m + 1, 4) and inputs (m, 2), the latter for each unit of the path's speed."""

    state: Array
    input: Array

    def moved(self, change: '_Trajectory', share: float) -> '_Trajectory':
        return _Trajectory(self.state + share * change.state, self.input + share * change.input)


def consistent_plan(
    plan: Plan, motion: Motion, largest_change: float = LARGEST_CHANGE
) -> Plan | None:
    """Re-plans from the same start along the same path with a motion's own equations.

    Args:
        plan: initial guess and path; inputs are tip velocities.
        motion: under tip velocities.
        largest_change: of [v_n, v_t] / speed from the guess.

    Returns:
        The new plan; None if the iteration fails or its result slides a lot.
    """
    problem = _Problem(plan, motion)
    result = problem.solved()
    if result is None or problem.departs(result, largest_change):
        return None
    return problem.sampled(result)


class _Problem:
    """Least squares about a target trajectory, subject to the equations of motion."""

    def __init__(self, plan: Plan, motion: Motion) -> None:
        moved = np.hypot(*np.diff(plan.state[:, :2], axis=0).T)
        self._speed = float(moved.mean()) / plan.period
        stride = max(1, round(_STEP / self._speed / plan.period))
        self._plan, self._motion = plan, motion
        self._knots = np.arange(0, len(plan.state), stride)
        self._interval = stride * plan.period
        self._width = self._interval * self._speed
        self._guess = _Trajectory(
            plan.state[self._knots], plan.input[self._knots[:-1]] / self._speed
        )
        self._target = _target(self._guess.state)
        self._weights = _STATE_WEIGHTS * self._width
        self._smooth = _CHANGE_WEIGHT / self._width

    def solved(self) -> _Trajectory | None:
        """The trajectory, None if the iteration does not converge."""
        now, merit = self._guess, self._merit(self._guess)
        for _ in range(_ITERATIONS):
            try:
                change = self._step(now)
            except (LinAlgError, ValueError):
                return None
            share = self._share(now, change, merit)
            if share < _SHORTEST:
                break
            now, before = now.moved(change, share), merit
            merit = self._merit(now)
            if share == 1.0 and merit > (1.0 - _DONE) * before:
                break
        return now if np.abs(self._defect(now)).max() < _SLACK else None

    def departs(self, result: _Trajectory, largest_change: float) -> bool:
        """Whether its inputs differ so much from the guess that the contact slides a lot.

        Sliding is where models are least accurate: in corners tighter than sticking allows, such
        a plan has 1.5 times the tracking error of the flat one.
        """
        return bool(np.abs(result.input - self._guess.input).max() > largest_change)

    def _share(self, now: _Trajectory, change: _Trajectory, merit: float) -> float:
        """Step length in (0, 1] that decreases the merit; below _SHORTEST if none does."""
        share = 1.0
        while share >= _SHORTEST and not self._merit(now.moved(change, share)) < merit:
            share *= 0.5
        return share

    def sampled(self, result: _Trajectory) -> Plan:
        """The trajectory at every sample of the plan."""
        time, knots = np.arange(len(self._plan.state)), self._knots
        middles = 0.5 * (knots[1:] + knots[:-1])
        state = [np.interp(time, knots, column) for column in result.state.T]
        inputs = [np.interp(time, middles, column) for column in self._speed * result.input.T]
        return replace(self._plan, state=np.stack(state, axis=-1), input=np.stack(inputs, axis=-1))

    def _merit(self, at: _Trajectory) -> float:
        error = at.state - self._target
        smooth = self._smooth * float((np.diff(at.input, axis=0) ** 2).sum())
        missed = float(np.abs(self._defect(at)).sum())
        return float((self._weights * error**2).sum() + smooth + _DEFECT_PRICE * missed)

    def _defect(self, at: _Trajectory) -> Array:
        """Defect of the equations of motion in each interval (m, 4)."""
        middle = 0.5 * (at.state[1:] + at.state[:-1])
        rates = self._motion.rates(middle, self._speed * at.input)
        return np.asarray(np.diff(at.state, axis=0) - self._interval * rates)

    def _step(self, at: _Trajectory) -> _Trajectory:
        """The Gauss-Newton step: a QP with equality constraints only.

        The unknowns are ordered by stage: four multipliers, the state, the input.
        """
        right = np.zeros((len(at.state), _STAGE))
        right[1:, :NX] = self._defect(at)
        right[:, _STATE] = self._weights * (at.state - self._target)
        bend = np.diff(at.input, axis=0)
        right[1:-1, _INPUT] = self._smooth * bend
        right[:-2, _INPUT] -= self._smooth * bend
        band = self._system(at)
        solution = solve_banded((_REACH, _REACH), band, -right.ravel(), overwrite_ab=True)
        stages = solution.reshape(right.shape)
        return _Trajectory(stages[:, _STATE], stages[:-1, _INPUT])

    def _system(self, at: _Trajectory) -> Array:
        """The optimality conditions as a banded matrix (2 reach + 1, unknowns)."""
        middle = 0.5 * (at.state[1:] + at.state[:-1])
        by_state, by_input = self._motion.linearised(middle, self._speed * at.input)
        half = 0.5 * self._interval * by_state
        band = _Band(len(at.state))
        band.add(0, 0, _STATE, np.eye(NX)[None])
        band.add(1, 0, _STATE, -np.eye(NX) - half)
        band.add(1, 1, _STATE, np.eye(NX) - half)
        band.add(1, 0, _INPUT, -self._width * by_input)
        band.diagonal(_STATE)[:] = self._weights
        own = band.diagonal(_INPUT)
        own[:-1] = _DAMPING * self._width
        own[1:-1] += self._smooth
        own[:-2] += self._smooth
        own[-1] = 1.0  # there is no input after the last state
        band.couple_inputs(-self._smooth)
        return band.values


class _Band:
    """A symmetric matrix with entries near its diagonal only, as LAPACK stores it."""

    def __init__(self, stages: int) -> None:
        self.values = np.zeros((2 * _REACH + 1, _STAGE * stages))
        self._stages = self.values.reshape(-1, stages, _STAGE)

    def add(self, row_stage: int, column_stage: int, columns: slice, blocks: Array) -> None:
        """Sets blocks (m, 4, k): rows of multipliers, and their mirror image.

        The first block has its rows in one stage and its columns in another; those after it
        follow stage by stage.
        """
        count, rows, _ = blocks.shape
        for row in range(rows):
            for number, column in enumerate(range(columns.start, columns.stop)):
                below = _STAGE * (row_stage - column_stage) + row - column
                entries = blocks[:, row, number]
                across = slice(column_stage, column_stage + count)
                along = slice(row_stage, row_stage + count)
                self._stages[_REACH + below, across, column] = entries
                self._stages[_REACH - below, along, row] = entries

    def diagonal(self, columns: slice) -> Array:
        """The diagonal of some columns of each stage, as a view (stages, k)."""
        return self._stages[_REACH, :, columns]

    def couple_inputs(self, value: float) -> None:
        """Sets the entries between each input and the same one of the next stage."""
        self._stages[_REACH + _STAGE, :-2, _INPUT] = value
        self._stages[_REACH - _STAGE, 1:-1, _INPUT] = value


def _target(state: Array) -> Array:
    """Target states (m + 1, 4): on the path, heading along it, p_y = 0."""
    x, y, heading, _ = state.T
    along = np.unwrap(np.arctan2(np.gradient(y), np.gradient(x)))
    along += 2.0 * np.pi * np.round((heading[0] - along[0]) / (2.0 * np.pi))
    return np.stack([x, y, along, np.zeros(len(x))], axis=-1)
