import numpy as np
import pytest
from push_bag.live.plan_markers import horizon_marker, marker_array, reference_marker
from push_msgs.msg import Horizon, NominalTrajectory


def points(marker) -> np.ndarray:
    return np.array([[point.x, point.y] for point in marker.points])


def test_the_reference_is_drawn_within_2_mm_with_few_points_and_to_its_end() -> None:
    turn = np.linspace(0.0, 3.0, 2000)
    x, y = 0.15 * np.cos(turn), 0.15 * np.sin(turn)
    drawn = points(reference_marker(NominalTrajectory(x=x.tolist(), y=y.tolist())))
    assert len(drawn) < 120
    gaps = np.linalg.norm(np.diff(drawn, axis=0), axis=1)
    assert gaps.max() < 0.005
    assert drawn[-1] == pytest.approx([x[-1], y[-1]])


def test_a_plan_without_points_draws_nothing() -> None:
    assert reference_marker(NominalTrajectory()).points == []


def test_both_lines_are_in_one_message_under_names_of_their_own() -> None:
    reference = reference_marker(NominalTrajectory(x=[0.0, 1.0], y=[0.0, 0.0]))
    horizon = horizon_marker(Horizon(x=[0.0, 0.1], y=[0.0, 0.0], theta=[0.0, 0.0]))
    assert [each.ns for each in marker_array(reference, horizon).markers] == [
        'reference',
        'horizon',
    ]
    assert marker_array(None, None).markers == []
