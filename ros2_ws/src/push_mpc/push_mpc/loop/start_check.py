"""Whether object and tip are where a plan begins, or a plan can begin where they are."""

import math

import numpy as np
from push_core.geometry import Array, wrap_angle
from push_core.physics import SafetyLimits, Slider

from push_mpc.plan import Placement, Plan

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
    return _tip_fault(slider, object_pose, tip)


def here_fault(
    slider: Slider, limits: SafetyLimits, plan: Plan, object_pose: Array, tip: Array
) -> str:
    """Why a plan cannot be moved to begin where the object lies, empty if it can.

    Args:
        slider: geometry of slider and tip.
        limits: with the workspace.
        plan: where the track has it.
        object_pose: measured pose (3,).
        tip: measured position of the tip (2,) [m].
    """
    return _tip_fault(slider, object_pose, tip) or _reach_fault(
        limits, Placement(plan.state[0, :3], object_pose).of(plan)
    )


def _tip_fault(slider: Slider, object_pose: Array, tip: Array) -> str:
    """Why the tip cannot push from where it is."""
    gap = slider.gap(object_pose, tip)
    offset = abs(slider.contact_offset(object_pose, tip))
    if not -DEEPEST < gap < WIDEST_GAP or offset > 0.5 * slider.side:
        return (
            f'the tip is not in front of the pushed face: {1e3 * gap:.0f} mm from its line '
            f'(at most {1e3 * WIDEST_GAP:.0f}, not inside the object), '
            f'{1e3 * offset:.0f} mm from its middle (at most {500.0 * slider.side:.0f})'
        )
    return ''


def _reach_fault(limits: SafetyLimits, plan: Plan) -> str:
    """Where a plan leaves the workspace."""
    followed = np.abs(plan.state[plan.time <= plan.duration, :2])
    beyond = followed - [limits.workspace_x, limits.workspace_y]
    farthest = int(np.argmax(beyond.max(axis=1)))
    if (excess := float(beyond[farthest].max())) <= 0.0:
        return ''
    x, y = plan.state[farthest, :2]
    return (
        f'from here the track leaves the workspace of +-{limits.workspace_x:g} m by '
        f'+-{limits.workspace_y:g} m by {1e3 * excess:.0f} mm, at x = {x:.3f} m, y = {y:.3f} m'
    )
