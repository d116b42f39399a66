"""The gate refuses every pose that cannot be, and no pose that can."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from push_core.physics.safety import SafetyLimits
from push_core.physics.slider import Slider
from push_mpc.estimate.pose_gate import PoseGate, Rejection
from push_mpc.loop.start_check import here_fault, start_fault
from push_mpc.settings.node_settings import mpc_settings
from push_mpc.settings.pose_gate_settings import PoseGateSettings

UPRIGHT = (0.0, 0.0, 0.0, 1.0)
PLACE = (0.1, -0.2, 0.0)


@pytest.fixture
def gate() -> PoseGate:
    return PoseGate(PoseGateSettings(), SafetyLimits())


def turned_about_x(degrees: float) -> tuple[float, float, float, float]:
    half = math.radians(degrees) / 2.0
    return (math.sin(half), 0.0, 0.0, math.cos(half))


BAD = {
    'frame': (('camera_optical', PLACE, UPRIGHT, 0.02), "'camera_optical', not 'world'"),
    'nan': (('world', (math.nan, 0.0, 0.0), UPRIGHT, 0.02), 'not finite'),
    'inf in the quaternion': (('world', PLACE, (0.0, 0.0, math.inf, 1.0), 0.02), 'not finite'),
    'zero quaternion': (('world', PLACE, (0.0, 0.0, 0.0, 0.0), 0.02), 'norm 0'),
    'unnormalised': (('world', PLACE, (0.0, 0.0, 0.0, 2.0), 0.02), 'norm 2'),
    'tilt': (('world', PLACE, turned_about_x(90.0), 0.02), 'tilted by 90 degrees'),
    'upside down': (('world', PLACE, (1.0, 0.0, 0.0, 0.0), 0.02), 'tilted by 180 degrees'),
    'millimetres': (('world', (-49.7, 0.0, 0.0), UPRIGHT, 0.02), 'are these metres?'),
    'an hour old': (('world', PLACE, UPRIGHT, 3600.0), r'3\.6e\+03 s old'),
    'half a second old': (('world', PLACE, UPRIGHT, 0.5), r'0\.5 s old'),
    'stamp 0': (('world', PLACE, UPRIGHT, 1.8e9), 'its stamp is not set, or is simulated time'),
    'future': (('world', PLACE, UPRIGHT, -0.02), r'0\.02 s in the future'),
    'far future': (('world', PLACE, UPRIGHT, -1.8e9), 'in the future'),
}


@pytest.mark.parametrize('kind', BAD)
def test_a_pose_that_cannot_be_is_refused_with_its_value(gate, kind: str) -> None:
    arguments, reason = BAD[kind]
    rejection = gate.check('object_pose', *arguments)
    assert isinstance(rejection, Rejection)
    assert rejection.reason.startswith('object_pose: ')
    with pytest.raises(AssertionError, match=reason):
        raise AssertionError(rejection.reason)
    assert gate.counts == {rejection.kind: 1}


@pytest.mark.parametrize(
    ('setting', 'frame', 'age'),
    [
        ({'frame': 'map'}, 'map', 0.02),
        ({'max_age': 1.0}, 'world', 0.5),
        ({'clock_tolerance': 0.1}, 'world', -0.05),
    ],
    ids=['frame', 'max_age', 'clock_tolerance'],
)
def test_each_setting_decides_what_is_accepted(gate, setting, frame: str, age: float) -> None:
    changed = PoseGate(PoseGateSettings(**setting), SafetyLimits())
    assert gate.check('object_pose', frame, PLACE, UPRIGHT, age) is not None
    assert changed.check('object_pose', frame, PLACE, UPRIGHT, age) is None


@given(
    x=st.floats(-0.7, 0.7),
    y=st.floats(-0.7, 0.7),
    yaw=st.floats(-math.pi, math.pi),
    tilt=st.floats(0.0, 9.0),
    age=st.floats(-0.005, 0.06),
    frame=st.sampled_from(['world', '']),
)
def test_a_pose_on_the_table_is_accepted(x, y, yaw, tilt, age, frame) -> None:
    # a turn about x by the tilt, then about z by the yaw
    sin, cos = math.sin(math.radians(tilt) / 2.0), math.cos(math.radians(tilt) / 2.0)
    s, c = math.sin(yaw / 2.0), math.cos(yaw / 2.0)
    quaternion = (c * sin, s * sin, s * cos, c * cos)
    gate = PoseGate(PoseGateSettings(), SafetyLimits())
    assert gate.check('object_pose', frame, (x, y, 0.03), quaternion, age) is None


numbers = st.floats(allow_nan=True, allow_infinity=True)


@given(
    position=st.tuples(numbers, numbers, numbers),
    quaternion=st.tuples(numbers, numbers, numbers, numbers),
    age=st.floats(allow_nan=False),
)
def test_what_is_accepted_is_finite_upright_and_near(position, quaternion, age) -> None:
    gate = PoseGate(PoseGateSettings(), SafetyLimits())
    if gate.check('object_pose', 'world', position, quaternion, age) is None:
        assert np.isfinite([*position, *quaternion]).all()
        assert max(abs(position[0]), abs(position[1])) <= 0.8
        assert abs(math.hypot(*quaternion) - 1.0) <= 0.01
        assert -0.005 <= age <= 0.06


START = np.array([0.1, 0.0, 0.0, 0.0])


@pytest.mark.parametrize(
    ('pose', 'tip', 'fault'),
    [
        ((0.1, 0.0, 0.0), (0.1 - 0.04975, 0.0), ''),
        ((0.11, 0.01, 0.1), (0.11 - 0.0498, 0.01), ''),
        ((0.2, 0.0, 0.0), (0.15, 0.0), '100 mm and 0 deg from the start'),
        ((0.1, 0.0, 1.0), (0.05, 0.0), '0 mm and 57 deg from the start'),
        ((0.1, 0.0, 0.0), (0.1, 0.0), 'the tip is not in front of the pushed face'),
        ((0.1, 0.0, 0.0), (0.05, 0.1), 'the tip is not in front of the pushed face'),
        ((0.1, 0.0, 0.0), (-0.3, 0.0), 'the tip is not in front of the pushed face'),
    ],
)
def test_a_plan_begins_only_where_object_and_tip_are(pose, tip, fault: str) -> None:
    text = start_fault(Slider(), START, np.array(pose), np.array(tip))
    assert text == '' if not fault else fault in text


@pytest.mark.parametrize(
    ('pose', 'tip', 'fault'),
    [
        ((-0.3, 0.1, 0.2), (0.099, 0.0), ''),
        ((-0.3, 0.1, 3.0), (0.1, 0.0), 'leaves the workspace of +-0.6 m by +-0.6 m by 195 mm'),
        ((-0.3, 0.1, 0.2), (0.15, 0.01), '150 mm from its line (at most 100'),
        ((-0.3, 0.1, 0.2), (0.0, 0.06), '60 mm from its middle (at most 45)'),
        ((-0.3, 0.1, 0.2), (-0.02, 0.0), '-20 mm from its line'),
    ],
)
def test_a_plan_is_moved_only_to_where_tip_and_workspace_permit(
    pose, tip: tuple[float, float], fault: str, plan_of
) -> None:
    """`tip` is gap and offset at the pushed face."""
    settings = replace(mpc_settings('ideal'), track='line')
    slider, object_pose = settings.slider, np.array(pose)
    place = slider.tip_position(object_pose, tip[1], tip[0])
    text = here_fault(slider, settings.limits, plan_of(settings), object_pose, place)
    assert text == '' if not fault else fault in text


def test_a_jump_is_refused_and_what_follows_at_the_old_place_is_not(gate) -> None:
    for count in range(20):
        away = 0.3 if count % 5 == 4 else 0.0
        rejection = gate.check('object_pose', 'world', (0.1 + away, 0.0, 0.0), UPRIGHT, 0.01)
        assert (rejection is not None) == (away > 0.0)
    assert gate.counts == {'jump': 4}


def test_what_stays_at_a_new_place_was_really_moved(gate) -> None:
    gate.check('object_pose', 'world', (0.0, 0.0, 0.0), UPRIGHT, 0.01)
    found = [gate.check('object_pose', 'world', (0.2, 0.0, 0.0), UPRIGHT, 0.01) for _ in range(10)]
    assert [rejection.kind if rejection else '' for rejection in found] == ['jump'] * 4 + [''] * 6


def test_after_a_reset_of_the_plant_a_new_run_begins_at_any_place(gate) -> None:
    gate.check('pusher_pose', 'world', (0.0, 0.0, 0.0), UPRIGHT, 0.01)
    gate.forget()
    assert gate.check('pusher_pose', 'world', (0.2, 0.0, 0.0), UPRIGHT, 0.01) is None


def test_motion_at_the_largest_speed_and_a_kick_are_no_jumps(gate) -> None:
    for place in (0.0, 0.0025, 0.005, 0.035, 0.0375):
        assert gate.check('object_pose', 'world', (place, 0.0, 0.0), UPRIGHT, 0.01) is None


def test_the_poses_of_object_and_tip_are_two_things(gate) -> None:
    assert gate.check('object_pose', 'world', (0.0, 0.0, 0.0), UPRIGHT, 0.01) is None
    assert gate.check('pusher_pose', 'world', (0.3, 0.0, 0.0), UPRIGHT, 0.01) is None
