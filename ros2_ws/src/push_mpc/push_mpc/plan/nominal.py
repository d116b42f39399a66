"""The nominal trajectory: sticking contact at p_y = 0 is differentially flat.

With alpha the side-slip (direction of travel minus heading), the centre follows a path of
curvature kappa(s) when alpha' = kappa + sin(alpha) / d, d = c^2 / |p_x|. This is unstable forwards
in s, so it is integrated backwards. Then v = speed [cos alpha, sin alpha],
omega = -speed sin(alpha) / d, and the contact point moves with u = [v_x, v_y + p_x omega].
"""

import math
from dataclasses import dataclass

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array
from push_core.physics import Slider
from push_core.tracks import Track

_LONGEST_STEP = 0.0003  # [m]
_SETTLING_LENGTHS = 30.0
_LARGEST_TURN = math.radians(45.0)  # between two samples; more is a corner


class TooTightError(InputError):
    """Sticking at the middle of the face cannot follow the track."""


@dataclass(frozen=True)
class Plan:
    """A timed reference, sampled every `period`; it extends past its end for the horizon.

    Attributes:
        period: time between samples [s].
        duration: time at which the reference ends [s].
        state: x [m], y [m], theta [rad, continuous], p_y [m]; (n, 4).
        input: v_n, v_t [m/s]; (n, 2).
    """

    period: float
    duration: float
    state: Array
    input: Array

    @property
    def time(self) -> Array:
        """Time of every sample [s], (n,)."""
        return self.period * np.arange(len(self.state))

    @property
    def speed(self) -> float:
        """Speed [m/s] of the object at the start."""
        return math.hypot(*np.diff(self.state[:2, :2], axis=0)[0]) / self.period

    def until_end(self) -> tuple[Array, Array, Array]:
        """Time (m,), state (m, 4), input (m, 2) of the reference, without the overrun.

        The last sample is that of its end, which may lie between two samples of the plan.
        """
        count = math.ceil(self.duration / self.period)
        last_state, last_input = self.at(self.duration)
        return (
            np.append(self.time[:count], self.duration),
            np.vstack([self.state[:count], last_state]),
            np.vstack([self.input[:count], last_input]),
        )

    def at(self, time: float) -> tuple[Array, Array]:
        """State (4,) and input (2,) at a time [s], held constant outside the plan."""
        place = min(max(time / self.period, 0.0), len(self.state) - 1.0)
        index = min(int(place), len(self.state) - 2)
        part = place - index
        state = (1.0 - part) * self.state[index] + part * self.state[index + 1]
        inputs = (1.0 - part) * self.input[index] + part * self.input[index + 1]
        return state, inputs


def flat_plan(
    track: Track, speed: float, slider: Slider, laps: int, period: float, overrun: float
) -> Plan:
    """The nominal trajectory of a slider along a track at constant speed.

    Args:
        track: path of the object's centre.
        speed: of the centre [m/s].
        slider: the pushed square.
        laps: number of laps.
        period: time between samples [s].
        overrun: time [s] by which the plan extends past its end.

    Raises:
        TooTightError: the path needs a force outside the friction cone.
    """
    duration = laps * track.length / speed
    samples = math.ceil((duration + overrun) / period) + 1
    s = speed * period * np.arange(samples)
    x, y, heading = path(track, s)
    _check_turns(track, s, heading, slider)
    alpha = _side_slip(track, s, _slip_length(slider))
    omega = -speed * np.sin(alpha) / _slip_length(slider)
    v_x, v_y = speed * np.cos(alpha), speed * np.sin(alpha)
    _check_friction(track, s, alpha, slider)
    state = np.stack([x, y, heading - alpha, np.zeros(samples)], axis=-1)
    return Plan(period, duration, state, np.stack([v_x, v_y + slider.p_x * omega], axis=-1))


def _slip_length(slider: Slider) -> float:
    """The length d = c^2 / |p_x| [m]."""
    return slider.support_radius**2 / abs(slider.p_x)


def path(track: Track, s: Array) -> tuple[Array, Array, Array]:
    """Position and heading (n,); an open track goes straight on after its end."""
    within = s if track.closed else np.minimum(s, track.length)
    x, y, heading, _ = track.at(within)
    beyond = s - within
    return x + beyond * np.cos(heading), y + beyond * np.sin(heading), heading


def _curvature(track: Track, s: Array) -> Array:
    if track.closed:
        return track.at(s)[3]
    return np.where(s <= track.length, track.at(np.minimum(s, track.length))[3], 0.0)


def _side_slip(track: Track, s: Array, slip_length: float) -> Array:
    """Side-slip alpha (n,) [rad] at arc lengths s (n,), by Runge-Kutta steps backwards in s."""
    settled = s[-1] + _SETTLING_LENGTHS * slip_length
    grid = _grid(track, s, settled)
    curvatures = _stage_curvatures(track, grid)
    alpha = np.empty(grid.size)
    alpha[-1] = 0.0
    for index in range(grid.size - 1, 0, -1):
        width = grid[index] - grid[index - 1]
        alpha[index - 1] = _step_back(alpha[index], curvatures[index - 1], width, slip_length)
    return alpha[np.searchsorted(grid, s)]


def _grid(track: Track, s: Array, settled: float) -> Array:
    """Arc lengths of the integration steps: all samples and all jumps of the curvature."""
    count = math.ceil((s[1] - s[0]) / _LONGEST_STEP)
    fine = np.linspace(s[0], s[-1], (s.size - 1) * count + 1)
    fine[::count] = s
    tail = np.arange(s[-1] + _LONGEST_STEP, settled, _LONGEST_STEP)
    laps = np.arange(math.ceil(settled / track.length)) if track.closed else np.zeros(1)
    jumps = (track.breakpoints[None, :] + laps[:, None] * track.length).ravel()
    inside = jumps[(jumps > s[0]) & (jumps < settled)]
    return np.unique(np.concatenate([fine, tail, inside]))


def _stage_curvatures(track: Track, grid: Array) -> Array:
    """Curvature just after the start, in the middle and just before the end of each step."""
    width = np.diff(grid)
    places = [grid[:-1] + part * width for part in (1e-6, 0.5, 1.0 - 1e-6)]
    return np.stack([_curvature(track, place) for place in places], axis=-1)


def _step_back(alpha: float, curvature: Array, width: float, slip_length: float) -> float:
    start, middle, end = (float(value) for value in curvature)
    k1 = end + math.sin(alpha) / slip_length
    k2 = middle + math.sin(alpha - 0.5 * width * k1) / slip_length
    k3 = middle + math.sin(alpha - 0.5 * width * k2) / slip_length
    k4 = start + math.sin(alpha - width * k3) / slip_length
    return float(alpha - width * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0)


def _check_friction(track: Track, s: Array, alpha: Array, slider: Slider) -> None:
    """At p_y = 0 the force has the direction of travel; it must be inside the friction cone."""
    worst = int(np.argmax(np.abs(alpha)))
    if abs(alpha[worst]) > math.atan(slider.friction_pusher):
        _refuse(track, s[worst], slider)


def _check_turns(track: Track, s: Array, heading: Array, slider: Slider) -> None:
    """Refuses corners, which the curvature does not show."""
    turns = np.abs(np.diff(heading))
    if turns.max() > _LARGEST_TURN:
        _refuse(track, s[int(np.argmax(turns))], slider)


def _refuse(track: Track, place: float, slider: Slider) -> None:
    tightest = _slip_length(slider) / math.sin(math.atan(slider.friction_pusher))
    raise TooTightError(
        f'track {track.name} turns too tightly near {place * 1e3:.0f} mm along it: with sticking '
        f'contact at the middle of the face the smallest radius is {tightest * 1e3:.0f} mm'
    )
