"""Finds when a fast tip meets the square within a time step.

PyBullet detects a contact only once two bodies overlap: a tip at 0.5 m/s would penetrate by half
a millimetre first. The scene cuts such a step in two at the first contact.
"""

from push_core.physics import Pair

from push_sim.worlds.common import Outline

DEEPEST = 1e-4
"""Penetration [m] that a step may cause without being cut."""

_IN_CONTACT = 1e-7
_OVERLAP = 5e-6
_BISECTIONS = 20


def fraction_until_contact(outline: Outline, start: Pair, end: Pair) -> float:
    """Fraction of a step after which the tip is in contact.

    Args:
        outline: of the square.
        start: body-frame position of the tip before the step [m].
        end: body-frame position of the tip after it [m].

    Returns:
        1 if the tip does not penetrate deeply, or was in contact before.
    """
    if outline.gap(*end) > -0.5 * DEEPEST or outline.gap(*start) < -_IN_CONTACT:
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        x = start[0] + middle * (end[0] - start[0])
        y = start[1] + middle * (end[1] - start[1])
        low, high = (middle, high) if outline.gap(x, y) > -_OVERLAP else (low, middle)
    return high
