"""Rolls a one-step model out along long pushes."""

import math

import numpy as np
from push_core.data import FACE_MARGIN, LongPushes
from push_core.geometry import Array, twist_of

from push_gp.models import PushModel

LONGEST_STEP = 1e-3
"""Travel of the tip in one step [m]; the prediction of the model is scaled to it."""


def rolled_out(model: PushModel, pushes: LongPushes) -> Array:
    """Predicted end poses (n, 3) of n long pushes.

    The tip moves straight. The object does not move while the tip is off the face or moves away.
    """
    pose = pushes.start.copy()
    travel = pushes.tip_end - pushes.tip_start
    steps = math.ceil(float(pushes.distance.max()) / LONGEST_STEP)
    part = pushes.distance[:, None] / (steps * model.distance)
    for step in range(steps):
        tip = pushes.tip_start + step / steps * travel
        moved = part * _moved(model, pushes, pose, tip)
        cos, sin = np.cos(pose[:, 2]), np.sin(pose[:, 2])
        pose[:, 0] += cos * moved[:, 0] - sin * moved[:, 1]
        pose[:, 1] += sin * moved[:, 0] + cos * moved[:, 1]
        pose[:, 2] += moved[:, 2]
    return pose


def _moved(model: PushModel, pushes: LongPushes, pose: Array, tip: Array) -> Array:
    """Twists (n, 3) in the body frame, times the duration of one push of the model."""
    cos, sin = np.cos(pose[:, 2]), np.sin(pose[:, 2])
    x, y = (tip - pose[:, :2]).T
    p_y = cos * y - sin * x
    direction = pushes.direction - pose[:, 2]
    # beta is the angle from the face, +y, to the direction of the push; pi/2 is along +x
    beta = np.arctan2(np.cos(direction), np.sin(direction))
    touches = (np.abs(p_y) <= pushes.slider.side / 2.0 + FACE_MARGIN) & (beta > 0.0)
    moved = np.zeros((len(pose), 3))
    moved[touches], _ = twist_of(*model.evaluate(p_y[touches], beta[touches]))
    return moved
