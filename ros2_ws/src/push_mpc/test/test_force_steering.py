"""The Family of Modes, against another solver and on states that call for one mode."""

from dataclasses import replace

import numpy as np
import pytest
from push_core.physics.limit_surface import LimitSurface
from push_core.physics.motion_cone import ContactMode, MotionCone
from push_core.tracks.built_in import by_name
from push_mpc.loop.controller import Mode
from push_mpc.loop.tracker import horizon_stride
from push_mpc.motion.contact_force import ContactForce
from push_mpc.plan.nominal import flat_plan
from push_mpc.qp.force_steering import FAMILY, ForceSteering
from push_mpc.settings.node_settings import mpc_settings
from push_sim.settings.plant_settings import PerturbationKind

SETTINGS = replace(
    mpc_settings('irb120'), controller='analytical', good_poses=3, consistent_plan=False
)
WEIGHTS = SETTINGS.force_weights
STATE_WEIGHTS = np.array(
    [WEIGHTS.position_x, WEIGHTS.position_y, WEIGHTS.heading, WEIGHTS.contact]
)
INPUT_WEIGHTS = np.array([WEIGHTS.normal, WEIGHTS.tangential, WEIGHTS.slip])
SPEEDS = np.array([LimitSurface.of(SETTINGS.slider).weights[0]] * 2 + [1.0])  # that inputs make
CHANGE_WEIGHTS = WEIGHTS.change * SPEEDS**2, np.zeros(3)


@pytest.fixture
def recorded(make_cell, recorded_problems):
    """Problems of each QP in 150 ticks with kicks, and the solutions."""
    cell = make_cell(SETTINGS)
    cell.controller.arm()
    kicks = {
        40: (PerturbationKind.TANGENTIAL, 0.02),
        80: (PerturbationKind.NORMAL, 0.02),
        120: (PerturbationKind.TANGENTIAL, -0.02),
    }
    for tick in range(160):
        if tick in kicks:
            cell.disturb(*kicks[tick])
        cell.tick()
    assert cell.controller.mode == Mode.TRACKING
    return recorded_problems


def test_each_qp_finds_the_first_input_of_the_other_solver(
    recorded, slider, independent_inputs
) -> None:
    friction, speed = slider.friction_pusher, ContactForce(slider).tip_velocity
    limited = np.array([[1, 0, 0], [-friction, 1, 0], [friction, 1, 0], [0, 0, 1]])
    for problem, solution in recorded[:: 3 * 5 + 1]:
        expected = independent_inputs(
            STATE_WEIGHTS, INPUT_WEIGHTS, CHANGE_WEIGHTS, limited, *problem
        )
        off = speed(0.0, solution.inputs[0]) - speed(0.0, expected[0])
        assert np.abs(off).max() < 3e-4


@pytest.fixture(scope='module')
def steering(slider):
    plan = flat_plan(by_name('line'), 0.08, slider, laps=1, period=0.01, overrun=2.0)
    return ForceSteering(SETTINGS, slider, 0.08), plan


@pytest.mark.parametrize(
    ('p_y', 'expected'),
    [
        (0.0, ContactMode.STICKING),
        (0.02, ContactMode.SLIDING_RIGHT),
        (-0.02, ContactMode.SLIDING_LEFT),
    ],
)
def test_an_offset_along_the_face_picks_the_mode_that_removes_it(
    steering, slider, p_y, expected
) -> None:
    family, plan = steering
    stride = horizon_stride(plan, SETTINGS)
    samples = stride * np.arange(SETTINGS.horizon_steps + 1)
    staged = family.staged(MotionCone(SETTINGS.slider), plan, stride, SETTINGS.slider)
    family.prepare(staged, samples)
    deviation = np.array([0.0, 0.0, 0.0, p_y])
    state = plan.state[0] + deviation
    sent = plan.input[0]
    move = family.solve(staged, state, deviation, 0.0, 0.0, np.zeros(3), sent)
    assert (move.usable, family.mode) == (True, expected)
    force = ContactForce(slider).of_velocity(np.array([p_y]), move.velocity[None])[0]
    assert np.sign(np.round(force[2], 6)) == expected


def test_another_friction_is_taken_without_building_a_solver(steering, slider) -> None:
    plan = steering[1]
    family = ForceSteering(SETTINGS, slider, plan.speed)
    other = replace(slider, friction_pusher=0.5, support_radius=0.04)
    stride = horizon_stride(plan, SETTINGS)
    samples = stride * np.arange(SETTINGS.horizon_steps + 1)
    staged = family.staged(MotionCone(other), plan, stride, other)
    solvers = family.solvers
    family.take(other)
    made = ForceSteering(SETTINGS, other, plan.speed)
    for each in (family, made):
        each.prepare(each.bounded(staged), samples)
    assert family.solvers == solvers
    for pair in zip(family.solvers, made.solvers, strict=True):
        ours, theirs = (each.problem for each in pair)
        assert (ours.matrix != theirs.matrix).nnz == 0
        np.testing.assert_array_equal(ours.high, theirs.high)
        np.testing.assert_array_equal(ours.low, theirs.low)


def test_the_family_differs_in_its_first_stage_alone(steering) -> None:
    family, plan = steering
    stages = family.staged(MotionCone(SETTINGS.slider), plan, 3, SETTINGS.slider).stages
    assert len(stages) == len(FAMILY) == 3
    widths = [stage.high[0] - stage.low[0] for stage in stages]
    assert [bool(width[4] > 0.0) for width in widths] == [False, True, True]


@pytest.mark.parametrize('p_y', [0.0, -0.02, 0.03])
def test_the_tip_is_never_faster_than_the_limit_wherever_it_touches(slider, p_y) -> None:
    plan = flat_plan(by_name('line'), 0.08, slider, laps=1, period=0.01, overrun=2.0)
    behind = np.array([-0.1, 0.0, 0.0, p_y])
    speeds = []
    for limit in (2.0, 0.1):
        family = ForceSteering(replace(SETTINGS, normal_speed_limit=limit), slider, 0.08)
        stride = horizon_stride(plan, SETTINGS)
        staged = family.staged(MotionCone(SETTINGS.slider), plan, stride, SETTINGS.slider)
        family.prepare(staged, stride * np.arange(SETTINGS.horizon_steps + 1))
        state, sent = plan.state[0] + behind, plan.input[0]
        move = family.solve(staged, state, behind, 0.0, 0.0, np.zeros(3), sent)
        assert move.usable
        speeds.append(move.velocity[0])
    free, bounded = speeds
    assert free > 0.12
    # the solver's tolerance
    assert 0.08 < bounded <= 0.1 + 1e-5
