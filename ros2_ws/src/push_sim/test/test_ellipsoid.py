"""The ellipsoid rolled out over tip paths."""

import math

import numpy as np
import pytest
from push_core.frames import rotation, to_world
from push_core.slider import Slider
from push_sim.ellipsoid import ELLIPSOID, one_step, rolled_out


def straight(slider: Slider, pose, p_y: float, beta: float, length: float, steps: int):
    """A tip path (1, k, 2) that begins in contact."""
    tip = slider.tip_position(pose, p_y)
    way = rotation(pose[2]) @ (length * np.array([math.sin(beta), math.cos(beta)]))
    return np.linspace(tip, tip + way, steps + 1)[None]


@pytest.mark.parametrize(('p_y', 'beta'), [(0.01, 1.2), (-0.03, 2.1), (0.0, 0.6)])
def test_a_very_short_push_is_one_step_of_the_motion_cone(p_y: float, beta: float) -> None:
    pose = np.array([0.3, -0.2, 0.9])
    end = rolled_out(ELLIPSOID, pose[None], straight(ELLIPSOID, pose, p_y, beta, 1e-6, 1))[0]
    moved = one_step(ELLIPSOID, np.array([[p_y, beta]]), 1e-6)[0]
    assert end[:2] == pytest.approx(to_world(pose, moved[:2]), abs=1e-12)
    assert end[2] - pose[2] == pytest.approx(moved[2], abs=1e-9)


def test_all_four_sides_answer_alike() -> None:
    at_rest = np.zeros(3)
    path = straight(ELLIPSOID, at_rest, 0.02, 1.3, 0.05, 200)
    expected = rolled_out(ELLIPSOID, at_rest[None], path)[0]
    for quarter in (1, 2, 3):
        turn = np.array([0.0, 0.0, quarter * math.pi / 2.0])
        assert rolled_out(ELLIPSOID, turn[None], path)[0] - turn == pytest.approx(expected)


def test_finer_steps_end_at_the_same_place() -> None:
    pose = np.zeros((1, 3))
    ends = [
        rolled_out(ELLIPSOID, pose, straight(ELLIPSOID, pose[0], 0.02, 1.2, 0.05, steps))[0]
        for steps in (500, 2000)
    ]
    assert np.all(np.abs(ends[0] - ends[1]) < [5e-5, 5e-5, 2e-3])


def test_a_tip_that_does_not_touch_moves_nothing_and_then_pushes_the_rest_of_its_way() -> None:
    pose = np.zeros((1, 3))
    touching = straight(ELLIPSOID, pose[0], 0.0, math.pi / 2.0, 0.01, 100)
    before = touching - [0.02, 0.0]
    assert np.array_equal(rolled_out(ELLIPSOID, pose, before), pose)
    arriving = np.concatenate((before, touching), axis=1)
    end = rolled_out(ELLIPSOID, pose, arriving)[0]
    assert end == pytest.approx([0.01, 0.0, 0.0], abs=1e-12)
