"""The frames on `/tf`."""

import numpy as np
from builtin_interfaces.msg import Time
from push_core.geometry.quaternion import quaternion_to_yaw
from push_sim.node.viewer_messages import Transforms


def test_object_and_tip_are_frames_of_the_world() -> None:
    message = Transforms('/').at(np.array([0.1, -0.2, 2.5]), np.array([0.3, 0.4]), Time(sec=5))
    slider, pusher = message.transforms
    assert (slider.header.frame_id, slider.child_frame_id) == ('world', 'slider')
    assert (pusher.header.frame_id, pusher.child_frame_id) == ('world', 'pusher')
    translation, turn = slider.transform.translation, slider.transform.rotation
    assert (translation.x, translation.y, translation.z) == (0.1, -0.2, 0.0)
    assert np.isclose(quaternion_to_yaw(turn.z, turn.w), 2.5)
    assert pusher.transform.translation.x == 0.3
    assert pusher.transform.rotation.w == 1.0
    assert slider.header.stamp.sec == pusher.header.stamp.sec == 5


def test_two_cells_have_frames_of_their_own() -> None:
    message = Transforms('/left').at(np.zeros(3), np.zeros(2), Time())
    names = {each.child_frame_id for each in message.transforms}
    assert names == {'left/slider', 'left/pusher'}
