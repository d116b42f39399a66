"""When in a time step a fast tip meets the square.

PyBullet sees a contact only once the two overlap, so that a tip at half a metre a second would be
half a millimetre deep before it is felt. A step that would do so is cut in two at the touch.
"""

from push_core.physics import Pair

from push_sim.worlds.common import Outline

DEEPEST = 1e-4
"""How deep [m] the tip may go before it is felt."""

_TOUCHING = 1e-7
_OVERLAP = 5e-6
_BISECTIONS = 20


def part_until_touch(outline: Outline, start: Pair, end: Pair) -> float:
    """Part of a step after which the tip, at body-frame points (2,) [m] before and after, touches.

    1 where it does not get deep, or was in touch before.
    """
    if outline.gap(*end) > -0.5 * DEEPEST or outline.gap(*start) < -_TOUCHING:
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        x = start[0] + middle * (end[0] - start[0])
        y = start[1] + middle * (end[1] - start[1])
        low, high = (middle, high) if outline.gap(x, y) > -_OVERLAP else (low, middle)
    return high
