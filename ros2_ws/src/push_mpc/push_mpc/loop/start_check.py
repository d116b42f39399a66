"""Whether object and tip are where a plan begins."""

import math

from push_core.geometry import Array, wrap_angle
from push_core.physics import Slider

FARTHEST = 0.02  # [m] of the object from the start of the plan
LARGEST_TURN = math.radians(15.0)
WIDEST_GAP = 0.1  # [m] between tip and face; the approach to the face closes it
DEEPEST = 2e-3  # [m]; deepest penetration of tip and object that measurement errors explain


def start_fault(slider: Slider, start: Array, object_pose: Array, tip: Array) -> str:
    """Why a plan cannot begin here, empty if it can.

    Args:
        slider: geometry of slider and tip.
        start: first state of the plan (4,) [m, m, rad, m].
        object_pose: measured pose (3,).
        tip: measured position of the tip (2,) [m].
    """
    away = math.hypot(*(object_pose[:2] - start[:2]))
    turn = wrap_angle(float(object_pose[2] - start[2]))
    if away > FARTHEST or abs(turn) > LARGEST_TURN:
        return (
            f'the object is {1e3 * away:.0f} mm and {math.degrees(turn):.0f} deg from the start '
            f'of the plan at x = {start[0]:.3f} m, y = {start[1]:.3f} m, '
            f'theta = {math.degrees(start[2]):.1f} deg'
        )
    gap = slider.gap(object_pose, tip)
    offset = abs(slider.contact_offset(object_pose, tip))
    if not -DEEPEST < gap < WIDEST_GAP or offset > 0.5 * slider.side:
        return (
            f'the tip is not in front of the pushed face: {1e3 * gap:.0f} mm from its line, '
            f'{1e3 * offset:.0f} mm from its middle'
        )
    return ''
