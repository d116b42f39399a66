"""The node as a process of its own, over real DDS; this process is plant, recorder and model."""

import signal
import time

import controller_node
import numpy as np
import pytest
from controller_node import LINE, PATIENCE, is_zero
from geometry_msgs.msg import PoseStamped, TwistStamped
from push_mpc.settings.node_settings import mpc_settings
from push_msgs.msg import ControllerState
from push_node import interface, qos
from push_node.stamps import to_nanoseconds
from rclpy.node import Node

pytestmark = pytest.mark.processes

# the fixtures
cell, started = controller_node.cell, controller_node.started
make_cell = controller_node.make_cell


def test_it_starts_only_when_all_is_there_and_says_what_is_not(cell, started) -> None:
    started(LINE)
    assert cell.call('start').message == 'waiting for the model: no model announced'
    cell.announce_model()
    cell.poses_on = True
    cell.call_until('start', lambda answer: 'recorder' in answer.message)
    cell.poses_on, cell.recording = False, True
    cell.states.clear()
    cell.poses_on = True
    cell.call_until('start', lambda answer: answer.success)
    assert cell.call('start').message == 'already started'
    cell.wait(lambda: cell.mode() == ControllerState.TRACKING)
    assert cell.states[-1].model_id == 'cone'


def test_it_does_not_start_without_poses(cell, started) -> None:
    started(LINE, 'require_recorder:=false')
    cell.announce_model()
    cell.call_until('start', lambda answer: 'model' not in answer.message)
    answer = cell.call('start')
    assert (answer.success, answer.message) == (
        False,
        'waiting for poses: nothing arrives on object_pose',
    )


def test_it_does_not_listen_to_the_ground_truth(cell, started) -> None:
    started(LINE)

    def heard() -> set[str]:
        # its name may come after its topics
        if ('mpc_node', '/') not in cell.node.get_node_names_and_namespaces():
            return set()
        topics = cell.node.get_subscriber_names_and_types_by_node('mpc_node', '/')
        return {name for name, _ in topics}

    cell.wait(lambda: len(cell.plans) > 0)
    cell.wait(lambda: interface.OBJECT_POSE.absolute_name in heard())
    assert interface.GROUND_TRUTH.absolute_name not in heard()


def test_it_starts_where_the_object_lies_and_says_what_hinders(cell, started) -> None:
    started('track:=line', 'start_from:=here', 'require_recorder:=false')
    place, gap = np.array([0.04, -0.03, 0.0]), 0.13

    def lie(message: PoseStamped) -> None:
        message.pose.position.x += place[0]
        message.pose.position.y += place[1]

    def withdraw(message: PoseStamped) -> None:
        message.pose.position.x -= gap

    cell.spoil, cell.spoil_tip, cell.poses_on = lie, withdraw, True
    cell.announce_model()
    cell.call_until('start', lambda answer: 'the tip is not' in answer.message)
    told = cell.call('start').message
    assert '130 mm from its line (at most 100' in told
    assert told.endswith('; move the tip or the object')
    assert (cell.plans[-1].x[0], cell.plans[-1].y[0]) == (0.0, 0.0)

    cell.spoil_tip = lambda message: None
    cell.call_until('start', lambda answer: answer.success)
    cell.wait(lambda: cell.plans[-1].x[0] == place[0])
    assert (cell.plans[-1].y[0], cell.plans[-1].theta[0]) == (place[1], 0.0)
    assert cell.plans[-1].x[-1] == pytest.approx(0.54)
    cell.wait(lambda: cell.mode() == ControllerState.TRACKING)
    cell.wait(lambda: np.isfinite(cell.states[-1].reference[0]))
    assert cell.states[-1].reference[1] == pytest.approx(place[1], abs=1e-3)


def test_it_is_silent_while_idle_and_announces_its_plan(cell, started) -> None:
    started(LINE)
    cell.poses_on = True
    cell.wait(lambda: len(cell.states) > 10)
    assert cell.commands == []
    cell.wait(lambda: bool(cell.plans))
    plan = cell.plans[0]
    assert (plan.track, plan.x[-1]) == ('line', pytest.approx(0.5))


def test_it_answers_each_pose_and_is_still_until_it_has_seen_ten(cell, started) -> None:
    started(LINE)
    cell.begin()
    cell.wait(lambda: len(cell.commands) > 20 and not is_zero(cell.commands[-1]))
    armed = [state for state in cell.states if state.mode == ControllerState.ARMED]
    assert len(armed) == 10
    # a listener that is late misses commands, so that they are told by the pose they answer
    stamps = [state.header.stamp for state in armed]
    answers = [command for command in cell.commands if command.header.stamp in stamps]
    assert answers
    assert all(is_zero(command) for command in answers)


def test_it_tells_its_plan_on_one_tick_in_five(cell, started) -> None:
    started(LINE)
    cell.begin()
    cell.wait(lambda: len(cell.horizons) >= 5)
    told = {to_nanoseconds(state.header.stamp): state.tick for state in cell.states}
    stamps = [to_nanoseconds(horizon.header.stamp) for horizon in cell.horizons]
    steps = np.diff([told[stamp] for stamp in stamps if stamp in told])
    assert np.all(steps % 5 == 0)
    steps = mpc_settings('irb120').horizon_steps
    assert {len(horizon.x) for horizon in cell.horizons} == {steps + 1}


def test_without_poses_it_holds_still_and_then_stops_until_resumed(cell, started) -> None:
    started(LINE, pose_loss=1.5)
    cell.begin()
    cell.poses_on = False
    cell.wait(lambda: cell.mode() in (ControllerState.HOLDING, ControllerState.STOPPED))
    cell.wait(lambda: is_zero(cell.commands[-1]))
    cell.wait(lambda: cell.mode() == ControllerState.STOPPED)
    assert cell.states[-1].stop_reason.startswith('no pose for ')
    cell.poses_on = True
    cell.commands.clear()
    cell.wait(lambda: len(cell.commands) > 10)
    assert all(is_zero(command) for command in cell.commands)
    assert 'call push_mpc/resume first' in cell.call('start').message
    assert cell.call('resume').success
    cell.call_until('start', lambda answer: answer.success)


def test_a_new_model_is_taken_over_without_a_missed_tick(cell, started) -> None:
    # slow, so that a busy machine has the model before the end of the line
    started(LINE, 'speed:=0.02')
    cell.begin()
    first = cell.states[-1].tick
    cell.announce_model('another')
    cell.wait(lambda: cell.states[-1].model_id == 'another')
    cell.wait(lambda: len(cell.states) > 20 and cell.states[-20].model_id == 'another')
    seen = [state for state in cell.states if state.tick >= first]
    # on a busy machine a pose of this test may come late
    ticks = [state for state in seen if state.mode != ControllerState.HOLDING]
    assert {state.mode for state in ticks} == {ControllerState.TRACKING}
    assert all(state.solver_status == 1 for state in ticks)
    assert {state.model_id for state in ticks} == {'cone', 'another'}
    answered = [(state.header.stamp.sec, state.header.stamp.nanosec) for state in ticks]
    assert len(set(answered)) == len(answered)


def test_stop_stops_at_once(cell, started) -> None:
    started(LINE)
    cell.begin()
    assert cell.call('stop').success
    cell.wait(lambda: cell.mode() == ControllerState.STOPPED)
    assert cell.states[-1].stop_reason == 'stopped on request'
    cell.wait(lambda: is_zero(cell.commands[-1]))


def test_it_stops_when_the_recorder_falls_silent(cell, started) -> None:
    started(LINE)
    cell.begin()
    cell.recording, silent_since = False, time.monotonic()
    cell.wait(lambda: cell.mode() == ControllerState.STOPPED)
    assert time.monotonic() - silent_since < 10.0, 'it came much later than the limit of 2 s'
    assert cell.states[-1].stop_reason == 'no report from the recorder for 2 s'
    cell.wait(lambda: is_zero(cell.commands[-1]))
    assert cell.call('resume').success
    assert cell.call('start').message == 'waiting for the recorder'
    cell.recording, cell.recorder_fault = True, 'no publisher of /object_pose'
    cell.call_until(
        'start',
        lambda answer: answer.message == 'waiting for the recorder: no publisher of /object_pose',
    )
    cell.recorder_fault = ''


def test_it_starts_only_when_the_recorder_hears_the_newest_nodes(cell, started) -> None:
    started(LINE)
    cell.begin()
    cell.unpublished = '/object_pose'
    assert not cell.happens(lambda: cell.mode() == ControllerState.STOPPED, 1.0)
    cell.call('stop')
    cell.call_until('resume', lambda answer: answer.success)
    reason = 'waiting for the recorder: it hears no publisher of /object_pose'
    cell.call_until('start', lambda answer: answer.message == reason)
    cell.unpublished = ''
    cell.call_until('start', lambda answer: answer.success)


def test_it_stops_when_the_recorder_reports_a_failure(cell, started) -> None:
    started(LINE)
    cell.begin()
    cell.recorder_fault = 'no space left on device'
    cell.wait(lambda: cell.mode() == ControllerState.STOPPED)
    assert cell.states[-1].stop_reason == ('the recorder does not record: no space left on device')


def test_without_a_required_recorder_its_end_is_no_stop(cell, started) -> None:
    started(LINE, 'require_recorder:=false')
    cell.begin()
    cell.recording = False
    assert not cell.happens(lambda: cell.mode() == ControllerState.STOPPED, 3.0)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_with_the_tip_at_rest(cell, started, number) -> None:
    process = started(LINE)
    cell.begin()
    cell.wait(lambda: not is_zero(cell.commands[-1]))
    process.send_signal(number)
    assert process.wait(timeout=PATIENCE) == 0
    cell.wait(lambda: is_zero(cell.commands[-1]))
    assert 'Traceback' not in process.stderr.read()


@pytest.mark.parametrize('parameter', ['track:=nine', 'speed:=0.3', 'horizn_steps:=3'])
def test_a_bad_parameter_fails_the_start_with_one_line_that_names_it(started, parameter) -> None:
    process = started(parameter)
    assert process.wait(timeout=PATIENCE) == 2
    lines = process.stderr.read().splitlines()
    assert len(lines) == 1
    assert parameter.split(':=')[0] in lines[0]


def test_a_node_in_lockstep_says_that_there_is_no_clock(cell, started) -> None:
    started(LINE, 'require_recorder:=false', 'mode:=lockstep')
    cell.announce_model()
    cell.poses_on = True
    cell.call_until('start', lambda answer: 'nothing on /clock' in answer.message)


def test_what_neither_plan_nor_table_is_made_of_changes_during_a_run(cell, started) -> None:
    started(LINE)
    cell.begin()
    assert cell.set(**{'recontact.gap': 0.004, 'recontact.speed': 0.1}) == ''
    assert cell.set(disturbance_length=0.0) == ''
    refused = cell.set(**{'recontact.gap': 0.003, 'recontact.speed': 9.0})
    assert 'parameter recontact.speed is 9, must be between 0.02 and 2 m/s' in refused
    assert cell.set(**{'weights.contact': 100.0, 'normal_speed_limit': 0.2}) == ''
    too_slow = cell.set(**{'weights.contact': 50.0, 'limits.speed': 0.07})
    assert 'needs a pusher speed of 0.080 m/s' in too_slow
    assert 'read-only while the node runs; start it again' in cell.set(horizon_steps=30)
    assert 'start it with mode:=lockstep' in cell.set(use_sim_time=True)
    # a shorter patience with missing poses takes effect at once
    assert cell.set(pose_loss=0.2) == ''
    assert cell.mode() == ControllerState.TRACKING
    cell.poses_on = False
    cell.wait(lambda: cell.mode() == ControllerState.STOPPED)


def test_a_second_source_of_poses_is_named_and_stops_the_run(cell, started) -> None:
    started(LINE)
    cell.begin()
    camera = Node('camera')
    publisher = camera.create_publisher(PoseStamped, 'object_pose', qos.POSE)
    cell.wait(lambda: cell.mode() == ControllerState.STOPPED)
    assert cell.states[-1].stop_reason == 'object_pose has 2 publishers: /camera, /cell'
    camera.destroy_publisher(publisher)
    camera.destroy_node()
    assert cell.call('resume').success
    cell.call_until('start', lambda answer: answer.success)


def test_a_second_commander_is_named_and_stops_the_run(cell, started) -> None:
    started(LINE)
    cell.begin()
    rogue = Node('teleop')
    publisher = rogue.create_publisher(TwistStamped, 'pusher_velocity_cmd', qos.COMMAND)
    cell.wait(lambda: cell.mode() == ControllerState.STOPPED)
    assert cell.states[-1].stop_reason == '/teleop commands the tip as well'
    assert cell.call('resume').success
    cell.call_until('start', lambda answer: '/teleop commands the tip as well' in answer.message)
    rogue.destroy_publisher(publisher)
    rogue.destroy_node()
    cell.call_until('start', lambda answer: answer.success)
