"""The optimal plan: for tracks without a flat solution (sharp corners, prescribed headings).

Direct collocation of the quasi-static motion (`contact_force.py`), solved by IPOPT before the run.
The contact may stick, or slide where its force is on the edge of the friction cone; the object
follows the timed track as closely as that allows. Lengths are scaled by the support radius c and
speeds by that of the track, so that all variables are of order one.
"""

import sys
from typing import Any

import casadi as ca
import numpy as np
from push_core.common import InputError, InterruptsHeld, interrupt_is_held
from push_core.geometry import Array

from push_mpc.motion import ContactForce
from push_mpc.plan.nominal import Plan, path
from push_mpc.plan.task import INTERVAL, PlanningTask

_DEGREE = 2
_FACE_SHARE, _SPEED_SHARE = 0.6, 0.9  # of the face and of the speed limits that a plan uses
_FARTHEST = 0.01  # [m]; largest accepted distance from the track
_SHARE = 0.1  # the same, as a share of the track's extent
_SMOOTHED = 0.05  # [m] of path over which the initial guess averages the track's heading
_CHANGE, _SLIP, _CONTACT, _ASIDE = 0.03, 0.01, 0.01, 0.03
_COMPLEMENTARITY = (0.1, 1e-4)  # slip times distance from the cone's edge, loose and then tight
_IPOPT: dict[str, Any] = {
    'print_time': False,
    'error_on_fail': False,
    'ipopt': {'print_level': 0, 'sb': 'yes', 'max_iter': 300, 'tol': 1e-7},
}


def optimal_plan(task: PlanningTask) -> Plan:
    """Plans the motion closest to the track; takes seconds.

    Raises:
        InputError: no plan stays near the track; names the place.
    """
    sys.stderr.write(
        f'planning {task.track.name} over {task.intervals} intervals, some seconds …\n'
    )
    reference = _reference(task)
    guess = _first_guess(task, reference)
    for tightness in _COMPLEMENTARITY:
        guess, solved = _solved(task, reference, guess, tightness)
    nodes, inputs = guess
    _check(task, nodes, reference, solved)
    return _sampled(task, nodes, inputs)


def _reference(task: PlanningTask) -> Array:
    """Position and heading (K + 1, 3) of the track at the intervals' ends."""
    s = task.speed * task.stride * task.period * np.arange(task.intervals + 1)
    return np.stack(path(task.track, s), axis=-1)


def _first_guess(task: PlanningTask, reference: Array) -> tuple[Array, Array]:
    """Initial guess: nodes (K + 1, 4) on the track with smoothed heading, pushed straight."""
    width = max(1, round(_SMOOTHED / INTERVAL))
    padded = np.pad(reference[:, 2], width, mode='edge')
    window = np.ones(2 * width + 1) / (2 * width + 1)
    nodes = np.zeros((task.intervals + 1, 4))
    nodes[:, :2] = reference[:, :2]
    nodes[:, 2] = np.convolve(padded, window, mode='valid')
    inputs = np.zeros((task.intervals, 4))
    inputs[:, 0] = task.speed
    return nodes, inputs


def _solved(
    task: PlanningTask, reference: Array, guess: tuple[Array, Array], tightness: float
) -> tuple[tuple[Array, Array], bool]:
    """Nodes (K + 1, 4) and inputs [f_n, f_t, slip left, slip right] (K, 4), both as speeds."""
    length, speed = task.slider.support_radius, task.speed
    problem = ca.Opti()
    nodes = problem.variable(4, task.intervals + 1)
    inputs = problem.variable(4, task.intervals)
    unit = np.array([length, length, 1.0, length])
    problem.set_initial(nodes, (guess[0] / unit).T)
    problem.set_initial(inputs, (guess[1] / speed).T)
    _collocate(problem, task, nodes, inputs, (guess[0] / unit).T)
    _limit(problem, task, nodes, inputs, tightness)
    _begin_and_end(problem, task, nodes, reference)
    target = (reference[:, :2] / length).T
    problem.minimize(
        ca.sumsqr(nodes[:2, :] - target)
        + _CHANGE * ca.sumsqr(inputs[:, 1:] - inputs[:, :-1])
        + _SLIP * ca.sumsqr(inputs[2:, :])
        + _CONTACT * ca.sumsqr(nodes[3, :])
        + _ASIDE * ca.sumsqr(inputs[1, :])
    )
    problem.solver('ipopt', _IPOPT)
    solved = _solve(problem)
    values = [np.asarray(problem.debug.value(each)).T for each in (nodes, inputs)]
    return (values[0] * unit, values[1] * speed), solved


def _solve(problem: ca.Opti) -> bool:
    """Whether IPOPT finds a solution; a Ctrl-C ends it after the current iteration.

    Raises:
        KeyboardInterrupt: Ctrl-C was pressed.
    """
    # casadi takes a Ctrl-C within a function for a failed evaluation, and goes on
    with InterruptsHeld():
        problem.callback(lambda _iteration: _end_if_interrupted())
        try:
            problem.solve()
        except RuntimeError:
            _end_if_interrupted()
            return False
        return True


def _end_if_interrupted() -> None:
    if interrupt_is_held():
        raise KeyboardInterrupt


def _rates(task: PlanningTask, state: ca.SX, inputs: ca.SX) -> ca.SX:
    """Dimensionless equations of motion."""
    length = task.slider.support_radius
    face, roll = task.slider.p_x / length, task.slider.tip_radius / length
    f_n, f_t, left, right = ca.vertsplit(inputs)
    turn = face * f_t - state[3] * f_n
    cos, sin = ca.cos(state[2]), ca.sin(state[2])
    return ca.vertcat(
        cos * f_n - sin * f_t, sin * f_n + cos * f_t, turn, left - right + roll * turn
    )


def _collocate(
    problem: ca.Opti, task: PlanningTask, nodes: ca.MX, inputs: ca.MX, start: Array
) -> None:
    """Collocation of the equations of motion; each interval ends in the next node."""
    slopes, ends, _ = ca.collocation_coeff(ca.collocation_points(_DEGREE, 'legendre'))
    width = task.stride * task.period * task.speed / task.slider.support_radius
    state, force = ca.SX.sym('state', 4), ca.SX.sym('force', 4)
    rates = ca.Function('rates', [state, force], [_rates(task, state, force)])
    inner = [problem.variable(4, task.intervals) for _ in range(_DEGREE)]
    for points in inner:
        problem.set_initial(points, start[:, :-1])
    stacked = [nodes[:, :-1], *inner]
    everywhere = rates.map(task.intervals)
    for column, points in enumerate(inner):
        slope = sum(point * slopes[row, column] for row, point in enumerate(stacked))
        problem.subject_to(slope == width * everywhere(points, inputs))
    end = sum(point * ends[row] for row, point in enumerate(stacked))
    problem.subject_to(end == nodes[:, 1:])


def _limit(
    problem: ca.Opti, task: PlanningTask, nodes: ca.MX, inputs: ca.MX, tightness: float
) -> None:
    """Constraints: friction cone, sliding on its edges only, face, tip speed."""
    slider, length = task.slider, task.slider.support_radius
    f_n, f_t, left, right = ca.vertsplit(inputs)
    upper = slider.friction_pusher * f_n - f_t
    lower = slider.friction_pusher * f_n + f_t
    problem.subject_to(ca.vec(ca.vertcat(f_n, left, right, upper, lower)) >= 0.0)
    problem.subject_to(ca.vec(ca.vertcat(left * upper, right * lower)) <= tightness)
    half = 0.5 * _FACE_SHARE * slider.side / length
    problem.subject_to(problem.bounded(-half, ca.vec(nodes[3, :]), half))
    contact, face = nodes[3, :-1], slider.p_x / length
    turn = face * f_t - contact * f_n
    fastest, aside = (_SPEED_SHARE * limit / task.speed for limit in task.speed_limits)
    problem.subject_to(problem.bounded(0.0, ca.vec(f_n - contact * turn), fastest))
    v_t = f_t + face * turn + left - right
    problem.subject_to(problem.bounded(-aside, ca.vec(v_t), aside))


def _begin_and_end(problem: ca.Opti, task: PlanningTask, nodes: ca.MX, reference: Array) -> None:
    """Start on the track, and the prescribed headings."""
    problem.subject_to(nodes[:2, 0] == reference[0, :2] / task.slider.support_radius)
    for node, heading in zip((0, task.last), task.headings, strict=True):
        if heading is not None:
            problem.subject_to(nodes[2, node] == heading)


def _check(task: PlanningTask, nodes: Array, reference: Array, solved: bool) -> None:
    away = np.hypot(*(nodes[:, :2] - reference[:, :2]).T)[: task.last + 1]
    worst = int(np.argmax(away))
    place = worst * task.stride * task.period * task.speed
    if not solved or away[worst] > min(_FARTHEST, _SHARE * np.ptp(reference[:, :2], axis=0).max()):
        raise InputError(
            f'track {task.track.name} cannot be pushed near {1e3 * place:.0f} mm along it: '
            f'the best plan leaves it by {1e3 * away[worst]:.0f} mm'
        )


def _sampled(task: PlanningTask, nodes: Array, inputs: Array) -> Plan:
    """The plan at every period: the motion equations integrated from each interval's start."""
    motion = ContactForce(task.slider)
    force = motion.of_speeds(inputs)
    states = [nodes[:-1]]
    for _ in range(task.stride - 1):
        states.append(_advanced(motion, states[-1], force, task.period))
    state = np.stack(states, axis=1).reshape(-1, 4)
    held = np.repeat(force, task.stride, axis=0)
    velocity = [motion.tip_velocity(row[3], each) for row, each in zip(state, held, strict=True)]
    return Plan(task.period, task.duration, state, np.array(velocity))


def _advanced(motion: ContactForce, state: Array, force: Array, duration: float) -> Array:
    """States (n, 4) after a Runge-Kutta step under constant inputs (n, 3)."""
    k1 = motion.rates(state, force)
    k2 = motion.rates(state + 0.5 * duration * k1, force)
    k3 = motion.rates(state + 0.5 * duration * k2, force)
    k4 = motion.rates(state + duration * k3, force)
    return np.asarray(state + duration / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4))
