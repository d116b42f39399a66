import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from push_core.common.errors import InputError
from push_core.physics.slider import Slider

LENGTHS = st.floats(-1.0, 1.0)
POSES = st.tuples(LENGTHS, LENGTHS, st.floats(-7.0, 7.0)).map(np.array)


def test_the_tip_behind_the_face_is_where_a_ruler_puts_it(slider) -> None:
    # 45 mm from centre to face, 4.75 mm of tip, 2 mm of gap, in an object that looks along +y
    pose = np.array([0.1, 0.2, math.pi / 2.0])
    tip = slider.tip_position(pose, 0.01, gap=0.002)
    assert tip == pytest.approx([0.1 - 0.01, 0.2 - 0.045 - 0.00475 - 0.002])


@given(POSES, st.floats(-0.06, 0.06), st.floats(-0.01, 0.5))
def test_offset_and_gap_are_read_back_from_the_tip_position(pose, p_y, gap) -> None:
    slider = Slider()
    tip = slider.tip_position(pose, p_y, gap)
    assert slider.contact_offset(pose, tip) == pytest.approx(p_y, abs=1e-14)
    assert slider.gap(pose, tip) == pytest.approx(gap, abs=1e-14)


def test_the_gap_is_negative_inside_the_face(slider) -> None:
    assert slider.gap(np.zeros(3), np.array([slider.tip_x + 0.001, 0.0])) < 0.0


def test_a_point_tip_touches_with_its_centre(slider) -> None:
    assert replace(slider, tip_radius=0.0).tip_x == slider.p_x == -0.045


def test_a_side_of_no_length_is_refused_by_name() -> None:
    with pytest.raises(InputError, match=r'side is 0, must be between 0.01 and 1 m'):
        Slider(side=0.0)
