"""A plan that was moved to where the object lies, and the controller that follows it."""

from dataclasses import replace

import numpy as np
import pytest
from push_core.geometry import rotation, to_world
from push_core.physics import MotionCone, Slider
from push_mpc.plan import Placement
from push_mpc.qp import ForceSteering, VelocitySteering
from push_mpc.settings.node_settings import mpc_settings

# along the last solution the tolerance of the solver would go on from tick to tick
SETTINGS = replace(mpc_settings('irb120'), good_poses=3, consistent_plan=False, relinearise=False)
THERE = np.array([0.11, -0.07, 2.4])


def moved(pose, placement):
    """A pose after the rigid motion of a placement."""
    turned = np.array([0.0, 0.0, placement.turn])
    place = placement.target[:2] + rotation(placement.turn) @ (pose[:2] - placement.origin[:2])
    return np.array([*place, pose[2] + turned[2]])


def test_it_begins_at_the_pose_to_the_last_bit_and_keeps_its_form(eight) -> None:
    plan = Placement(eight.state[0, :3], THERE).of(eight)
    np.testing.assert_array_equal(plan.state[0, :3], THERE)
    np.testing.assert_array_equal(plan.input, eight.input)
    np.testing.assert_array_equal(plan.state[:, 3], eight.state[:, 3])
    steps, before = (np.diff(each.state[:, :3], axis=0) for each in (plan, eight))
    np.testing.assert_allclose(np.hypot(*steps[:, :2].T), np.hypot(*before[:, :2].T), atol=1e-12)
    np.testing.assert_allclose(steps[:, 2], before[:, 2], atol=1e-12)


@pytest.mark.parametrize('steering', [VelocitySteering, ForceSteering])
def test_stages_that_were_turned_are_those_of_the_plan_that_was_turned(
    steering, eight, slider, table
) -> None:
    placement = Placement(eight.state[0, :3], THERE)
    made = steering(SETTINGS, slider, 0.08)
    turned = made.staged(table, eight, 5, slider).placed(placement)
    anew = made.staged(table, placement.of(eight), 5, slider)
    for ours, theirs in zip(turned.stages, anew.stages, strict=True):
        for name in ('target', 'low', 'high'):
            np.testing.assert_allclose(
                getattr(ours, name), getattr(theirs, name), rtol=1e-7, atol=1e-7, err_msg=name
            )


def test_the_controller_does_there_what_it_does_at_the_start_of_the_track(make_cell) -> None:
    here, there = make_cell(SETTINGS), make_cell(SETTINGS)
    placement = Placement(here.controller.plan.state[0, :3], THERE)
    here.controller.arm()
    there.controller.arm(THERE)
    for number in range(120):
        pose, tip = here.seen.object_pose, here.seen.tip_position
        times = here.seen.time - here.plant.START, here.plant.time - here.plant.START
        at_home = here.tick()
        away = there.controller.step(
            moved(pose, placement), moved(np.array([*tip, 0.0]), placement)[:2], *times
        )
        there.controller.prepare_next()
        assert away.mode == at_home.mode, number
        if at_home.predicted is not None:
            np.testing.assert_allclose(away.input, at_home.input, atol=2e-5)
            np.testing.assert_allclose(away.state[:3], moved(at_home.state[:3], placement))
            np.testing.assert_allclose(
                away.reference[:3], moved(at_home.reference[:3], placement), atol=1e-9
            )


def test_a_new_model_is_followed_along_the_moved_plan(make_cell, tabulated) -> None:
    made = make_cell(SETTINGS)
    made.controller.arm(THERE)
    other = tabulated(MotionCone(Slider(friction_pusher=0.4)))
    made.controller.use(made.controller.prepare_model(other, 'other'))
    np.testing.assert_array_equal(made.controller.plan.state[0, :3], THERE)
    tip = to_world(THERE, np.array([SETTINGS.slider.tip_x, 0.0]))
    ticks = [made.controller.step(THERE, tip, 0.01 * n, 0.01 * n + 0.001) for n in range(4)]
    assert ticks[-1].reference is not None
    assert ticks[-1].reference[:2] == pytest.approx(THERE[:2], abs=1e-6)


def test_the_next_start_may_be_that_of_the_track_again(make_cell) -> None:
    made, fresh = make_cell(SETTINGS), make_cell(SETTINGS)
    made.controller.arm(THERE)
    made.controller.stop('asked to')
    tip = to_world(THERE, np.array([SETTINGS.slider.tip_x, 0.0]))
    for number in range(30):
        made.controller.step(THERE, tip, 0.01 * number, 0.01 * number)
    made.controller.resume()
    made.controller.arm()
    fresh.controller.arm()
    np.testing.assert_array_equal(made.controller.plan.state, fresh.controller.plan.state)
    for _ in range(30):
        np.testing.assert_array_equal(made.tick().velocity, fresh.tick().velocity)
