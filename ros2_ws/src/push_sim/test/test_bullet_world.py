import math

import numpy as np
import pytest
from push_core.geometry.frames import to_body
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider
from push_sim.settings.world_settings import WorldSettings
from push_sim.worlds.bullet.bullet_world import BulletWorld

ORIGIN = np.zeros(3)


@pytest.fixture
def world(slider: Slider) -> BulletWorld:
    return BulletWorld(WorldSettings(), slider)


def test_short_pushes_follow_the_motion_cone(world, slider: Slider) -> None:
    settings = WorldSettings()
    same = Slider(friction_pusher=settings.friction_pusher, support_radius=settings.support_radius)
    for p_y, beta in [(0.0, 1.2), (0.02, 1.6), (-0.03, 1.0), (0.01, 2.4)]:
        velocity = 0.02 * np.array([math.sin(beta), math.cos(beta)])
        world.reset(ORIGIN, slider.tip_position(ORIGIN, p_y))
        world.advance(velocity, 20)
        before = world.object_pose
        world.advance(velocity, 50)
        after = world.object_pose
        mean, _ = MotionCone(same).evaluate(np.array([p_y]), np.array([beta]))
        motion = np.array([*to_body(before, after[:2]), after[2] - before[2]])
        # four feet are no ellipsoid: the two agree to a fifth of the push
        assert np.all(np.abs(motion / 0.001 - mean[0]) < [0.2, 0.2, 5.0])
