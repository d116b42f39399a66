"""Checks that the tip of a robot run pushed the face that the heading names."""

import numpy as np
from push_core.common import InputError
from push_core.data import RobotRun
from push_core.geometry import points_to_body
from push_core.physics import Slider

LARGEST_GAP = 0.01  # [m] between tip and face, typically; measured runs have 0.6 mm
MOVED = 1e-3  # [m] by which the object has moved, or is still to move


def check_contact(run: RobotRun, slider: Slider) -> None:
    """Checks that the tip is at the pushed face while the object moves.

    Raises:
        InputError: it is elsewhere: the size, the tip or the zero of the heading differ.
    """
    points = run.pose[:, :2]
    moving = np.linalg.norm(points - points[0], axis=1) > MOVED
    moving &= np.linalg.norm(points - points[-1], axis=1) > MOVED
    if not moving.any():
        return
    x, y = points_to_body(run.pose[moving], run.tip[moving]).T
    gap = float(np.median(slider.tip_x - x))
    if abs(gap) > LARGEST_GAP:
        place = f'x {1e3 * np.median(x):.0f} mm, y {1e3 * np.median(y):.0f} mm'
        raise InputError(
            f"{run.name}: while the object moves, the tip is at {place} in the object's frame, "
            f'not at its face x {1e3 * slider.tip_x:.0f} mm; give --side and --tip-radius, and a '
            'heading whose x axis points away from the tip'
        )
