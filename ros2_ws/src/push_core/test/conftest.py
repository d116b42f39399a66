"""The square of the cell, its motion cone, and tracks as files."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from push_core.geometry.frames import Array
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider


@pytest.fixture(scope='session')
def slider() -> Slider:
    return Slider()


@pytest.fixture(scope='session')
def cone(slider: Slider) -> MotionCone:
    return MotionCone(slider)


@pytest.fixture
def write_track(tmp_path: Path) -> Callable[..., Path]:
    """Writes points (n, 2) [m] as a track file."""

    def write(points: Array, heading: str = 'x,y\n', name: str = 'track.csv') -> Path:
        rows = ''.join(f'{float(x)!r},{float(y)!r}\n' for x, y in points)
        (tmp_path / name).write_text(heading + rows, encoding='utf-8')
        return tmp_path / name

    return write


@pytest.fixture
def circle_csv(write_track: Callable[..., Path]) -> Path:
    """A circle of radius 200 mm about the origin, 120 points, closed."""
    angle = np.linspace(0.0, 2.0 * np.pi, 121)
    points = 0.2 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    points[-1] = points[0]
    return write_track(points, name='circle.csv')
