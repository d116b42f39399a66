"""Cuts the measured motion of a lap into short pushes, in the format of training pushes."""

import math

import numpy as np
from numpy.typing import NDArray
from push_core.data import P_Y_LIMIT, PushSet
from push_core.geometry import Array
from push_core.physics import GRAZING, Slider

from push_gp.learn.smoothing import PoseNoise, pose_noise, smoothed_at

CONTACT_GAP = 1e-3
"""Largest measured gap [m] at which the tip is taken to push, of a camera without noise."""

FARTHEST_NOISE = 4.5
"""Standard deviations of the camera's noise that a gap may be larger: one in 300,000 poses is."""

OTHER_SIZE = 0.12
"""Share of the size by which the object may be another than the nominal one."""

JUMP = np.array([2e-3, 0.03])
"""Motion [m], [rad] of the object from one picture to the next that any push may make; noise of
the camera comes on top."""

FARTHEST = 1e3
"""Largest value of a pose [m], [rad] or of the tip [m] that can have been measured."""

JUMP_RATIO = 5.0
"""A larger motion is a jump if it is so many times the median: speed and noise set that."""


def segments(object_poses: Array, tips: Array, slider: Slider, distance: float) -> PushSet:
    """The pushes of a stretch of measurements, one after the other.

    Samples without contact, and jumps of the object that no push explains, end a segment. Noisy
    poses are smoothed over the way of the tip.

    Args:
        object_poses: (m, 3) in the order of time, world frame [m, m, rad].
        tips: (m, 2) positions of the tip at the same times [m].
        slider: geometry of slider and tip.
        distance: travel of the tip in each push [m].
    """
    poses = np.array(object_poses, dtype=float).reshape(-1, 3)
    known = np.abs(poses[:, 2]) < FARTHEST
    poses[known, 2] = np.unwrap(poses[known, 2])
    starts, ends, noise = [], [], noise_of(poses, tips)
    for run in _pushing_runs(poses, tips, slider):
        moved = np.hypot(*np.diff(tips[run], axis=0).T)
        travel = np.concatenate(([0.0], np.cumsum(moved)))
        marks = np.arange(0.0, travel[-1], distance)
        track = np.column_stack((poses[run], tips[run]))
        at_marks = smoothed_at(marks, travel, track, noise.width(distance))
        starts.append(at_marks[:-1])
        ends.append(at_marks[1:])
    if not starts:
        return _empty(distance)
    return _as_pushes(np.vstack(starts), np.vstack(ends), distance)


def _pushing_runs(poses: Array, tips: Array, slider: Slider) -> list[slice]:
    """Stretches of samples in which the tip pushed without an interruption."""
    if len(poses) < 2:
        return []
    broken = interrupted(poses, tips, slider)
    edges = np.flatnonzero(np.diff(np.concatenate(([0], ~broken[1:], [0])).astype(int)))
    return [slice(first, last + 1) for first, last in edges.reshape(-1, 2)]


def interrupted(object_poses: Array, tips: Array, slider: Slider) -> NDArray[np.bool_]:
    """Samples (m,) which the push from the one before does not explain: no contact, a jump.

    Args:
        object_poses: (m, 3) in the order of time, headings without jumps of a turn.
        tips: (m, 2) positions of the tip [m].
        slider: geometry of slider and tip.
    """
    rows = np.column_stack((object_poses, tips))
    # where one is not a number, the comparison is false
    unknown = ~(np.abs(rows) < FARTHEST).all(axis=1)
    rows[unknown] = 0.0
    along, _ = _in_frame(rows, rows[:, 3:] - rows[:, :2])
    noise = noise_of(object_poses, tips)
    gap = max(CONTACT_GAP, FARTHEST_NOISE * noise.position)
    apart: NDArray[np.bool_] = unknown | (_face(along[~unknown], slider) - along > gap)
    steps = np.diff(rows, axis=0)
    moved = np.stack([np.hypot(*steps[:, :2].T), np.abs(steps[:, 2]), np.hypot(*steps[:, 3:].T)])
    usual = JUMP_RATIO * np.median(moved, axis=1, keepdims=True)
    twice = math.sqrt(2.0) * FARTHEST_NOISE
    least = JUMP[0] + twice * noise.position, JUMP[1] + twice * noise.angle, JUMP[0]
    jumps = (moved > np.maximum(usual, np.array(least)[:, None])).any(axis=0)
    result = apart.copy()
    result[1:] |= apart[:-1] | jumps
    return result


def noise_of(object_poses: Array, tips: Array) -> PoseNoise:
    """The noise of the poses (m, 3) that can have been measured, for tips (m, 2)."""
    rows = np.column_stack((object_poses, tips))
    known = (np.abs(rows) < FARTHEST).all(axis=1)
    return pose_noise(rows[known, :3], rows[known, 3:])


def _face(along: Array, slider: Slider) -> float:
    """Where the tip touches [m]: its median, as far as an object of another size explains it."""
    if not along.size:
        return slider.tip_x
    reach = OTHER_SIZE * 0.5 * slider.side
    return float(np.clip(np.median(along), slider.tip_x - reach, slider.tip_x + reach))


def _as_pushes(start: Array, end: Array, distance: float) -> PushSet:
    """Pushes from rows [x, y, theta, tip x, tip y] at their starts and ends (n, 5)."""
    forwards, aside = _in_frame(start, end[:, 3:] - start[:, 3:])
    beta = np.arctan2(forwards, aside)
    _, p_y = _in_frame(start, start[:, 3:] - start[:, :2])
    moved = np.column_stack(_in_frame(start, end[:, :2] - start[:, :2]))
    displacement = np.column_stack((moved, end[:, 2] - start[:, 2]))
    good = (np.abs(p_y) < P_Y_LIMIT) & (beta > GRAZING) & (beta < np.pi - GRAZING)
    good &= np.isfinite(displacement).all(axis=1)
    return PushSet(p_y[good], beta[good], displacement[good], distance)


def _in_frame(poses: Array, vectors: Array) -> tuple[Array, Array]:
    """World vectors (n, 2) along and across the heading of poses (n, 3 or more)."""
    cos, sin = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    x, y = vectors.T
    return cos * x + sin * y, cos * y - sin * x


def _empty(distance: float) -> PushSet:
    return PushSet(np.empty(0), np.empty(0), np.empty((0, 3)), distance)
