"""A plan where the flat solution does not exist: sharp corners, given headings.

Direct collocation of the quasi-static motion (`contact_force.py`), solved once by IPOPT before
anything moves. The contact may stick, or slide where its force is on the friction cone's edge; the
object follows the timed track as closely as that allows. Lengths are in support radii c and speeds
in that of the track, so that every number is about one.
"""

import math
import sys
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from push_core.common import InputError
from push_core.geometry import Array
from push_core.physics import Slider
from push_core.tracks import Track

from push_mpc.motion import ContactForce
from push_mpc.plan.nominal import Plan, path

_INTERVAL = 0.003  # [m] of path with one force
_DEGREE = 2
_FACE_SHARE, _SPEED_SHARE = 0.6, 0.9  # of the face and of the speed limits that a plan uses
_FARTHEST = 0.01  # [m] from the track; more is no plan for it
_SHARE = 0.1  # of the track's extent, likewise
_SETTLED = 0.05  # [m] over which the first guess of the heading smooths the track's
_CHANGE, _SLIP, _CONTACT, _ASIDE = 0.03, 0.01, 0.01, 0.03
_COMPLEMENTARITY = (0.1, 1e-4)  # slip times distance from the cone's edge, loose and then tight
_IPOPT: dict[str, Any] = {
    'print_time': False,
    'error_on_fail': False,
    'ipopt': {'print_level': 0, 'sb': 'yes', 'max_iter': 300, 'tol': 1e-7},
}


@dataclass(frozen=True)
class Task:
    """What is to be planned.

    Attributes:
        track: path of the object's centre.
        speed: of the reference along it [m/s].
        slider: the pushed square.
        duration: time at which the reference ends [s].
        overrun: time [s] for which the plan goes on after its end.
        period: time between samples [s].
        speed_limits: of v_n and of |v_t| [m/s].
        headings: of the object at start and end [rad], None where it is free.
    """

    track: Track
    speed: float
    slider: Slider
    duration: float
    overrun: float
    period: float
    speed_limits: tuple[float, float]
    headings: tuple[float | None, float | None]

    @property
    def stride(self) -> int:
        """Samples in one interval."""
        return max(1, round(_INTERVAL / self.speed / self.period))

    @property
    def intervals(self) -> int:
        """Intervals of constant force."""
        return math.ceil((self.duration + self.overrun) / (self.stride * self.period))

    @property
    def last(self) -> int:
        """The interval's start at which the reference ends."""
        return min(self.intervals, round(self.duration / (self.stride * self.period)))


def optimal_plan(task: Task) -> Plan:
    """The plan that follows the track most closely; takes seconds.

    Raises:
        InputError: there is none near the track; names the place.
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


def _reference(task: Task) -> Array:
    """Position and heading (K + 1, 3) of the track at the intervals' ends."""
    s = task.speed * task.stride * task.period * np.arange(task.intervals + 1)
    return np.stack(path(task.track, s), axis=-1)


def _first_guess(task: Task, reference: Array) -> tuple[Array, Array]:
    """Nodes (K + 1, 4) on the track, heading along it but smoothly, pushed straight."""
    width = max(1, round(_SETTLED / _INTERVAL))
    padded = np.pad(reference[:, 2], width, mode='edge')
    window = np.ones(2 * width + 1) / (2 * width + 1)
    nodes = np.zeros((task.intervals + 1, 4))
    nodes[:, :2] = reference[:, :2]
    nodes[:, 2] = np.convolve(padded, window, mode='valid')
    inputs = np.zeros((task.intervals, 4))
    inputs[:, 0] = task.speed
    return nodes, inputs


def _solved(
    task: Task, reference: Array, guess: tuple[Array, Array], tightness: float
) -> tuple[tuple[Array, Array], bool]:
    """Nodes (K + 1, 4) and inputs [f_n, f_t, slip left, slip right] (K, 4), both as speeds."""
    length, speed = task.slider.support_radius, task.speed
    program = ca.Opti()
    nodes = program.variable(4, task.intervals + 1)
    inputs = program.variable(4, task.intervals)
    unit = np.array([length, length, 1.0, length])
    program.set_initial(nodes, (guess[0] / unit).T)
    program.set_initial(inputs, (guess[1] / speed).T)
    _collocate(program, task, nodes, inputs, (guess[0] / unit).T)
    _limit(program, task, nodes, inputs, tightness)
    _begin_and_end(program, task, nodes, reference)
    wanted = (reference[:, :2] / length).T
    program.minimize(
        ca.sumsqr(nodes[:2, :] - wanted)
        + _CHANGE * ca.sumsqr(inputs[:, 1:] - inputs[:, :-1])
        + _SLIP * ca.sumsqr(inputs[2:, :])
        + _CONTACT * ca.sumsqr(nodes[3, :])
        + _ASIDE * ca.sumsqr(inputs[1, :])
    )
    program.solver('ipopt', _IPOPT)
    try:
        program.solve()
    except RuntimeError:
        solved = False
    else:
        solved = True
    found = [np.asarray(program.debug.value(each)).T for each in (nodes, inputs)]
    return (found[0] * unit, found[1] * speed), solved


def _rates(task: Task, state: ca.SX, inputs: ca.SX) -> ca.SX:
    """The motion equations without units."""
    length = task.slider.support_radius
    face, roll = task.slider.p_x / length, task.slider.tip_radius / length
    f_n, f_t, left, right = ca.vertsplit(inputs)
    turn = face * f_t - state[3] * f_n
    cos, sin = ca.cos(state[2]), ca.sin(state[2])
    return ca.vertcat(
        cos * f_n - sin * f_t, sin * f_n + cos * f_t, turn, left - right + roll * turn
    )


def _collocate(program: ca.Opti, task: Task, nodes: ca.MX, inputs: ca.MX, start: Array) -> None:
    """Each interval's polynomial obeys the motion equations and ends in the next node."""
    slopes, ends, _ = ca.collocation_coeff(ca.collocation_points(_DEGREE, 'legendre'))
    width = task.stride * task.period * task.speed / task.slider.support_radius
    state, force = ca.SX.sym('state', 4), ca.SX.sym('force', 4)
    rates = ca.Function('rates', [state, force], [_rates(task, state, force)])
    inner = [program.variable(4, task.intervals) for _ in range(_DEGREE)]
    for points in inner:
        program.set_initial(points, start[:, :-1])
    stacked = [nodes[:, :-1], *inner]
    everywhere = rates.map(task.intervals)
    for column, points in enumerate(inner):
        slope = sum(point * slopes[row, column] for row, point in enumerate(stacked))
        program.subject_to(slope == width * everywhere(points, inputs))
    end = sum(point * ends[row] for row, point in enumerate(stacked))
    program.subject_to(end == nodes[:, 1:])


def _limit(program: ca.Opti, task: Task, nodes: ca.MX, inputs: ca.MX, tightness: float) -> None:
    """Friction cone, sliding only on its edges, the face's ends and the tip's speed."""
    slider, length = task.slider, task.slider.support_radius
    f_n, f_t, left, right = ca.vertsplit(inputs)
    upper = slider.friction_pusher * f_n - f_t
    lower = slider.friction_pusher * f_n + f_t
    program.subject_to(ca.vec(ca.vertcat(f_n, left, right, upper, lower)) >= 0.0)
    program.subject_to(ca.vec(ca.vertcat(left * upper, right * lower)) <= tightness)
    half = 0.5 * _FACE_SHARE * slider.side / length
    program.subject_to(program.bounded(-half, ca.vec(nodes[3, :]), half))
    contact, face = nodes[3, :-1], slider.p_x / length
    turn = face * f_t - contact * f_n
    fastest, aside = (_SPEED_SHARE * limit / task.speed for limit in task.speed_limits)
    program.subject_to(program.bounded(0.0, ca.vec(f_n - contact * turn), fastest))
    v_t = f_t + face * turn + left - right
    program.subject_to(program.bounded(-aside, ca.vec(v_t), aside))


def _begin_and_end(program: ca.Opti, task: Task, nodes: ca.MX, reference: Array) -> None:
    """Starts on the track; headings as wanted."""
    program.subject_to(nodes[:2, 0] == reference[0, :2] / task.slider.support_radius)
    for node, heading in zip((0, task.last), task.headings, strict=True):
        if heading is not None:
            program.subject_to(nodes[2, node] == heading)


def _check(task: Task, nodes: Array, reference: Array, solved: bool) -> None:
    away = np.hypot(*(nodes[:, :2] - reference[:, :2]).T)[: task.last + 1]
    worst = int(np.argmax(away))
    place = worst * task.stride * task.period * task.speed
    if not solved or away[worst] > min(_FARTHEST, _SHARE * np.ptp(reference[:, :2], axis=0).max()):
        raise InputError(
            f'track {task.track.name} cannot be pushed near {1e3 * place:.0f} mm along it: '
            f'the best plan leaves it by {1e3 * away[worst]:.0f} mm'
        )


def _sampled(task: Task, nodes: Array, inputs: Array) -> Plan:
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
