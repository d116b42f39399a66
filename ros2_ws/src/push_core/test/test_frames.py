import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from push_core.geometry.frames import (
    points_to_body,
    rotation,
    to_body,
    to_world,
    wrap_angle,
    wrap_angles,
)

ANGLES = st.floats(-1e3, 1e3)
LENGTHS = st.floats(-10.0, 10.0)
POINTS = st.tuples(LENGTHS, LENGTHS).map(np.array)
POSES = st.tuples(LENGTHS, LENGTHS, ANGLES).map(np.array)


@given(POSES, POINTS)
def test_a_point_comes_back_from_the_body_frame_and_from_the_world(pose, point) -> None:
    assert np.allclose(to_world(pose, to_body(pose, point)), point, atol=1e-13)
    assert np.allclose(to_body(pose, to_world(pose, point)), point, atol=1e-13)


def test_a_quarter_turn_takes_the_body_x_axis_to_the_world_y_axis() -> None:
    pose = np.array([1.0, 2.0, math.pi / 2.0])
    assert np.allclose(to_world(pose, np.array([0.5, 0.0])), [1.0, 2.5], atol=1e-15)
    assert np.allclose(rotation(pose[2]) @ [0.0, 1.0], [-1.0, 0.0], atol=1e-15)


@given(ANGLES)
def test_a_wrapped_angle_is_the_same_direction_within_half_a_turn(angle) -> None:
    wrapped = wrap_angle(angle)
    assert -math.pi <= wrapped <= math.pi
    assert math.cos(wrapped) == pytest.approx(math.cos(angle), abs=1e-12)
    assert math.sin(wrapped) == pytest.approx(math.sin(angle), abs=1e-12)


@given(st.floats(-3.0, 3.0))
def test_an_angle_within_half_a_turn_keeps_every_bit(angle) -> None:
    assert wrap_angle(angle) == angle


@given(st.lists(POSES, min_size=1), POINTS)
def test_many_points_go_to_their_body_frames_as_one_does(poses, point) -> None:
    found = points_to_body(np.array(poses), np.tile(point, (len(poses), 1)))
    assert np.allclose(found, [to_body(pose, point) for pose in poses], atol=1e-13)


@given(st.lists(ANGLES, min_size=1))
def test_many_angles_are_wrapped_as_one_is(angles) -> None:
    found = wrap_angles(np.array(angles))
    assert ((found >= -math.pi) & (found < math.pi)).all()
    assert np.allclose(np.cos(found), np.cos(angles), atol=1e-12)
    assert np.allclose(np.sin(found), np.sin(angles), atol=1e-12)
