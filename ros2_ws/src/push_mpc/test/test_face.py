"""Where the face is found to be, from how the object moves with the tip."""

import numpy as np
import pytest
from push_core.geometry import to_world
from push_mpc.estimate import FaceEstimator

HEADING = 0.7
STEP = 8e-4  # [m] in a tick


def pushed(slider, gap: float, ticks: int, noise: float = 0.0) -> FaceEstimator:
    """After a push of so many ticks with a constant measured gap [m]."""
    face, generator = FaceEstimator(slider), np.random.default_rng(1)
    for tick in range(ticks):
        pose = to_pose(tick * STEP)
        tip = slider.tip_position(pose, 0.01, gap) + noise * generator.normal(size=2)
        face.observe(pose, tip)
    return face


def to_pose(travel: float) -> np.ndarray:
    return np.array([*to_world(np.array([0.1, 0.2, HEADING]), np.array([travel, 0.0])), HEADING])


@pytest.mark.parametrize('gap', [0.0045, -0.0045])
def test_a_gap_that_stays_while_the_object_moves_with_the_tip_is_none(slider, gap) -> None:
    face = pushed(slider, gap, 40)
    assert face.offset == pytest.approx(gap, abs=1e-5)
    pose = to_pose(0.0)
    touching = face.touching(pose, slider.tip_position(pose, 0.01, gap))
    assert slider.gap(pose, touching) == pytest.approx(0.0, abs=1e-5)


def test_with_measurement_noise_it_is_found_too(slider) -> None:
    assert pushed(slider, 0.0045, 80, noise=2e-4).offset == pytest.approx(0.0045, abs=5e-4)


def test_a_gap_that_measurements_explain_is_left_alone(slider) -> None:
    face = pushed(slider, 0.001, 80, noise=2e-4)
    pose = to_pose(0.0)
    tip = slider.tip_position(pose, 0.01, 0.001)
    assert face.offset == 0.0
    assert face.touching(pose, tip) is tip


def test_ten_millimetres_of_pushing_are_needed(slider) -> None:
    assert pushed(slider, 0.0045, 10).offset == 0.0


def test_a_tip_that_approaches_an_object_at_rest_finds_nothing(slider) -> None:
    face, pose = FaceEstimator(slider), to_pose(0.0)
    for tick in range(60):
        face.observe(pose, slider.tip_position(pose, 0.01, 0.05 - tick * STEP))
    assert face.offset == 0.0


def test_a_new_start_forgets_it(slider) -> None:
    face = pushed(slider, 0.0045, 40)
    face.reset()
    assert face.offset == 0.0
