"""The ellipsoidal limit surface beside which the simulator is judged, rolled out over tip paths.

Its two numbers are those that fit the measured 4 mm pushes best.
"""

import math

import numpy as np
from push_core.frames import Array
from push_core.motion_cone import MotionCone
from push_core.slider import Slider

ELLIPSOID = Slider(friction_pusher=0.229, support_radius=0.0348)
"""The square with the fitted friction of the pusher and moment over force [m]."""


def one_step(slider: Slider, inputs: Array, distance: float) -> Array:
    """Displacements (n, 3) [m, m, rad] of short pushes, by the motion cone at their start.

    Args:
        slider: what is pushed.
        inputs: (n, 2) p_y [m] and beta [rad].
        distance: travel of the tip [m].
    """
    rate, _ = MotionCone(slider).evaluate(*inputs.T)
    return rate * distance


def rolled_out(slider: Slider, start: Array, tip: Array) -> Array:
    """End poses (n, 3) [m, m, rad] of n objects whose tips follow n paths.

    Args:
        slider: what is pushed.
        start: (n, 3) object poses [m, m, rad].
        tip: (n, k, 2) centres of the tips [m], in steps of a fraction of a millimetre.

    The tip pushes on the face that it is nearest to at the start, from where it touches the face
    and as long as it is beside it.
    """
    cone, quarter = MotionCone(slider), _nearest_face(start, tip[:, 0])
    pose = start + np.column_stack((np.zeros((len(start), 2)), quarter))
    for before, after in zip(tip[:, :-1].swapaxes(0, 1), tip[:, 1:].swapaxes(0, 1), strict=True):
        pose = _pushed(cone, pose, before, after)
    return np.asarray(pose - np.column_stack((np.zeros((len(start), 2)), quarter)))


def _nearest_face(start: Array, tip: Array) -> Array:
    """By which multiple of a right angle (n,) to turn the frames, so that tips are at -x."""
    x, y = _turned(tip - start[:, :2], -start[:, 2]).T
    right_angles = np.round(np.arctan2(-y, -x) / (math.pi / 2.0))
    return np.asarray(right_angles * (math.pi / 2.0))


def _pushed(cone: MotionCone, pose: Array, before: Array, after: Array) -> Array:
    """Poses (n, 3) after the tips went straight on; only what reaches into the face pushes."""
    slider = cone.slider
    begin = _turned(before - pose[:, :2], -pose[:, 2])
    travel = _turned(after - before, -pose[:, 2])
    normal = begin[:, 0] + travel[:, 0] - slider.tip_x
    pushing = (normal > 0.0) & (travel[:, 0] > 0.0)
    part = np.clip(normal / np.where(pushing, travel[:, 0], 1.0), 0.0, 1.0)
    p_y = begin[:, 1] + (1.0 - part) * travel[:, 1]
    pushing &= np.abs(p_y) <= slider.side / 2.0
    tangential = part * travel[:, 1]
    rate, _ = cone.evaluate(p_y, np.arctan2(np.where(pushing, normal, 1.0), tangential))
    moved = rate * np.where(pushing, np.hypot(normal, tangential), 0.0)[:, None]
    shift = _turned(moved[:, :2], pose[:, 2])
    return np.asarray(pose + np.column_stack((shift, moved[:, 2])))


def _turned(vectors: Array, angles: Array) -> Array:
    """Vectors (n, 2), each turned by its angle (n,) [rad]."""
    cos, sin = np.cos(angles), np.sin(angles)
    x, y = vectors.T
    return np.column_stack((cos * x - sin * y, sin * x + cos * y))
