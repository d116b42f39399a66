"""Recontact: detects a lost contact and steers the tip back to the face.

The QP assumes contact. While there is a gap, the tip instead approaches the planned contact point
at a bounded speed, first along the face if it would miss it; after touching, the QP resumes.
"""

from dataclasses import dataclass

import numpy as np
from push_core.common import setting, validate
from push_core.geometry import Array
from push_core.physics import Slider

_TOUCH = 5e-4  # [m]; gap below which contact is regained
_APPROACH_TIME = 0.05  # [s]; time constant of the approach
_SLOWEST = 0.02  # [m/s]
_FACE_SHARE = 0.9  # of the face; outside it the tip moves along the face only
_BEHIND = 5e-3  # [m]; a tip this far past the face line is not in front of the face


@dataclass(frozen=True)
class RecontactSettings:
    """When contact counts as lost, and how fast the tip comes back."""

    gap: float = setting(
        0.002, 'gap from which contact counts as lost', unit='m', low=0.001, high=1.0
    )
    speed: float = setting(
        0.2, 'largest speed of the approach to the face', unit='m/s', low=0.02, high=2.0
    )

    def __post_init__(self) -> None:
        validate(self)


def is_apart(settings: RecontactSettings, gap: float, was_apart: bool) -> bool:
    """Whether contact is lost, with hysteresis: lost above `gap`, regained at touch."""
    return gap > (_TOUCH if was_apart else settings.gap)


def departure(slider: Slider, gap: float, p_y: float) -> str:
    """Why the tip can no longer reach the face; empty if it can.

    Args:
        slider: geometry of slider and tip.
        gap: between tip and face [m].
        p_y: contact offset [m].
    """
    if gap > -_BEHIND:
        return ''
    if gap < -slider.side - slider.tip_radius:
        return 'the pusher is behind the object; it has left the pushed face for good'
    if abs(p_y) > 0.5 * slider.side:
        return 'the pusher is beside the object; it has left the pushed face for good'
    # inside the object, which is impossible: a frozen camera image; the next pose decides
    return ''


def approach(
    settings: RecontactSettings, slider: Slider, gap: float, p_y: float, target: float
) -> Array:
    """Velocity (2,) [m/s] in the body frame towards the face.

    Args:
        settings: bounds.
        slider: geometry of slider and tip.
        gap: between tip and face [m].
        p_y: current contact offset [m].
        target: desired contact offset [m].
    """
    faces = abs(p_y) < _FACE_SHARE * 0.5 * slider.side
    v_n = max(gap / _APPROACH_TIME, _SLOWEST) if faces else 0.0
    velocity = np.array([v_n, (target - p_y) / _APPROACH_TIME])
    speed = float(np.hypot(*velocity))
    return np.asarray(velocity * min(1.0, settings.speed / max(speed, 1e-9)))
