"""Pushes at speed, against the balance of forces of an object on an arc."""

from dataclasses import replace

import numpy as np
import pytest
from push_core.physics import MotionCone, Slider, slider_at_speed, with_inertia

SPEED = 0.3
FORWARDS = np.linspace(1.0, 2.1, 23)
MIDDLE = np.zeros(len(FORWARDS))


def test_a_slider_at_speed_sticks_as_inertia_lets_it():
    rough = replace(Slider(), friction_pusher=1.0)
    fast = MotionCone(slider_at_speed(rough, SPEED)).evaluate(MIDDLE, FORWARDS)[0]
    slow = MotionCone(rough).evaluate(MIDDLE, FORWARDS)
    assert fast == pytest.approx(with_inertia(rough, SPEED, MIDDLE, *slow)[0], abs=1e-9)


def test_a_slider_at_speed_slides_where_the_whole_contact_force_is_at_the_edge():
    slider = Slider()
    grazing = np.array([0.3, 0.4, 2.7, 2.8])
    moved = MotionCone(slider_at_speed(slider, SPEED)).evaluate(np.zeros(4), grazing)[0]
    # friction with the table is along the motion; the rest of the force accelerates the centre
    acceleration = SPEED**2 / (slider.friction_ground * 9.81) * moved[:, 2]
    share = (moved[:, 1] + acceleration) / moved[:, 0]
    assert np.abs(share) == pytest.approx(slider.friction_pusher, rel=1e-9)
