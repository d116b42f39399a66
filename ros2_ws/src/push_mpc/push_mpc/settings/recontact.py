"""Loss of contact: whether the tip pushes, and how it comes back to the face.

The program knows no tip off the face: it would plan as if each command moved the object. While
there is a gap, the tip approaches the planned contact point at a bounded speed instead, along the
face first where it would miss it; once it touches, the program catches up with the reference.
"""

from dataclasses import dataclass

import numpy as np
from push_core.common import setting, validate
from push_core.geometry import Array
from push_core.physics import Slider

_TOUCH = 5e-4  # [m]; a gap that counts as contact again
_APPROACH_TIME = 0.05  # [s] in which the rest of the way would be gone
_SLOWEST = 0.02  # [m/s]
_FACE_SHARE = 0.9  # of the face that the tip approaches
_BEHIND = 5e-3  # [m] inside the line of the face where no face can be


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
    """Whether a tip at a gap [m] has to approach first; it then does so until it touches."""
    return gap > (_TOUCH if was_apart else settings.gap)


def departure(slider: Slider, gap: float, p_y: float) -> str:
    """Why a tip at a gap [m] and contact offset p_y [m] can push no more, empty if it can."""
    if gap > -_BEHIND:
        return ''
    if gap < -slider.side - slider.tip_radius:
        return 'the pusher is behind the object; it has left the pushed face for good'
    if abs(p_y) > 0.5 * slider.side:
        return 'the pusher is beside the object; it has left the pushed face for good'
    # inside the object, where it cannot be: a picture that froze, and soon mends
    return ''


def approach(
    settings: RecontactSettings, slider: Slider, gap: float, p_y: float, target: float
) -> Array:
    """Velocity (2,) [m/s] in the body frame towards the face.

    Args:
        settings: bounds.
        slider: geometry of slider and tip.
        gap: between tip and face [m].
        p_y: where the tip would touch [m].
        target: where it shall [m].
    """
    faces = abs(p_y) < _FACE_SHARE * 0.5 * slider.side
    v_n = max(gap / _APPROACH_TIME, _SLOWEST) if faces else 0.0
    velocity = np.array([v_n, (target - p_y) / _APPROACH_TIME])
    speed = float(np.hypot(*velocity))
    return np.asarray(velocity * min(1.0, settings.speed / max(speed, 1e-9)))
