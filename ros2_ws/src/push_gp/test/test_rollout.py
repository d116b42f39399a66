import numpy as np
import pytest
from push_core.data.long_pushes import LongPushes
from push_core.physics.slider import Slider
from push_gp.evaluation.rollout import rolled_out
from push_gp.models.analytical_model import AnalyticalModel

SLIDER = Slider()


def push(pose: list[float], p_y: float, turn: float, length: float = 0.05) -> LongPushes:
    """One push at an offset, in a direction turned from the inward normal, not yet measured."""
    start = np.array(pose)
    tip = SLIDER.tip_position(start, p_y)
    heading = start[2] + turn
    end = tip + length * np.array([np.cos(heading), np.sin(heading)])
    return LongPushes(SLIDER, start[None], start[None], tip[None], end[None])


def test_a_push_through_the_centre_moves_the_object_with_the_tip() -> None:
    end = rolled_out(AnalyticalModel(), push([0.1, 0.2, 0.7], 0.0, 0.0))
    assert np.allclose(end, [[0.1 + 0.05 * np.cos(0.7), 0.2 + 0.05 * np.sin(0.7), 0.7]])


def test_the_rollout_is_the_same_in_every_frame() -> None:
    here = rolled_out(AnalyticalModel(), push([0.0, 0.0, 0.0], 0.02, 0.3))[0]
    there = rolled_out(AnalyticalModel(), push([0.5, 0.0, np.pi / 2.0], 0.02, 0.3))[0]
    assert np.allclose(there, [0.5 - here[1], here[0], np.pi / 2.0 + here[2]])


def test_a_tip_off_the_face_or_on_its_way_out_moves_nothing() -> None:
    for p_y, turn in ((0.0465, 0.0), (0.0, 1.8), (0.0, np.pi)):
        nowhere = push([0.0, 0.0, 0.0], p_y, turn)
        assert np.array_equal(rolled_out(AnalyticalModel(), nowhere), nowhere.start)


def test_a_tip_that_slides_off_leaves_the_object_where_it_was_then() -> None:
    long = rolled_out(AnalyticalModel(), push([0.0, 0.0, 0.0], 0.04, 1.2, 0.05))
    longer = rolled_out(AnalyticalModel(), push([0.0, 0.0, 0.0], 0.04, 1.2, 0.1))
    assert longer == pytest.approx(long, abs=1e-3)
