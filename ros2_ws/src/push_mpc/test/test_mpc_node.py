"""The node as a process of its own, over real DDS; this process is plant, recorder and model."""

import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator

import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped, TwistStamped
from node_tests import own_domain
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider
from push_mpc.settings.node_settings import mpc_settings
from push_msgs.msg import ControllerState, Horizon, ModelInfo, NominalTrajectory
from push_msgs.srv import Predict
from push_node import interface, qos
from push_node.ask import ask
from push_node.spin import Spinner
from push_node.stamps import to_nanoseconds, to_stamp
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_srvs.srv import Trigger

pytestmark = pytest.mark.processes

PATIENCE = 60.0  # [s]; nothing but a hang takes that long
LINE = 'track:=line'


class Cell:
    """Everything around the controller, standing still at the start of the line."""

    def __init__(self, pose_qos: QoSProfile = qos.POSE) -> None:
        self.node = Node('cell')
        self.spinner = Spinner(self.node)
        self.poses_on = self.recording = False
        self._noise = random.Random(0)
        self.spoil: Callable[[PoseStamped], None] = lambda message: None
        self.spoil_tip: Callable[[PoseStamped], None] = lambda message: None
        self.model_id = self.recorder_fault = ''
        self.states: list[ControllerState] = []
        self.commands: list[TwistStamped] = []
        self.plans: list[NominalTrajectory] = []
        self.horizons: list[Horizon] = []
        node, slider = self.node, Slider()
        self._tip = slider.tip_position(np.zeros(3), 0.0)
        self._cone = MotionCone(slider)
        self._object = node.create_publisher(PoseStamped, 'object_pose', pose_qos)
        self._pusher = node.create_publisher(PoseStamped, 'pusher_pose', pose_qos)
        self._models = node.create_publisher(ModelInfo, 'model_info', qos.LATCHED)
        self._health = node.create_publisher(DiagnosticArray, '/diagnostics', 10)
        node.create_subscription(
            ControllerState, 'controller_state', self.states.append, qos.STATE
        )
        node.create_subscription(
            TwistStamped, 'pusher_velocity_cmd', self.commands.append, qos.COMMAND
        )
        node.create_subscription(
            NominalTrajectory, 'nominal_trajectory', self.plans.append, qos.LATCHED
        )
        node.create_subscription(Horizon, 'horizon', self.horizons.append, qos.STATE)
        node.create_service(Predict, 'push_gp/predict', self._predict)
        self._calls = {
            name: node.create_client(Trigger, f'push_mpc/{name}')
            for name in ('start', 'stop', 'resume')
        }
        self._set = node.create_client(
            SetParametersAtomically, 'mpc_node/set_parameters_atomically'
        )
        node.create_timer(0.01, self._expose)
        node.create_timer(0.2, self._report)

    def _predict(self, request: Predict.Request, answer: Predict.Response) -> Predict.Response:
        mean, jacobian = self._cone.evaluate(np.array(request.p_y), np.array(request.beta))
        answer.success, answer.model_id = True, self.model_id
        answer.mean = (0.004 * mean).ravel().tolist()
        answer.jacobian = (0.004 * jacobian).ravel().tolist()
        return answer

    def _expose(self) -> None:
        if not self.poses_on:
            return
        stamp = self.node.get_clock().now().to_msg()
        for publisher, place in ((self._object, (0.0, 0.0)), (self._pusher, self._tip)):
            message = PoseStamped()
            message.header.stamp = stamp
            message.header.frame_id = 'world'
            message.pose.position.x, message.pose.position.y = map(float, place)
            self.spoil(message)
            if publisher is self._pusher:
                # real cameras never see the same twice
                message.pose.position.x += self._noise.uniform(-1e-6, 1e-6)
                self.spoil_tip(message)
            publisher.publish(message)

    def send_tip(self, stamp: int, aside: float) -> None:
        """The tip at the face of the object, aside from its middle [m]."""
        self._pusher.publish(_pose(stamp, self._tip[0], aside))

    def send_object(self, stamp: int) -> None:
        self._object.publish(_pose(stamp, 0.0, 0.0))

    def answered(self, stamp: int) -> bool:
        return to_nanoseconds(self.states[-1].header.stamp) == stamp

    def _report(self) -> None:
        if self.recording:
            status = DiagnosticStatus(level=DiagnosticStatus.OK, name='/recorder: recording')
            if self.recorder_fault:
                status.level, status.message = DiagnosticStatus.ERROR, self.recorder_fault
            self._health.publish(DiagnosticArray(status=[status]))

    def report_as(self, name: str, behind: float) -> None:
        """A status with a stamp by a clock that is behind [s]."""
        stamp = self.node.get_clock().now().nanoseconds - round(1e9 * behind)
        array = DiagnosticArray(status=[DiagnosticStatus(name=name)])
        array.header.stamp = to_stamp(stamp)
        self._health.publish(array)

    def announce_model(self, model_id: str = 'cone') -> None:
        self.model_id = model_id
        info = ModelInfo(model_id=model_id, distance=0.004)
        info.p_y_domain, info.beta_domain = (-0.045, 0.045), (0.1, 3.0)
        self._models.publish(info)

    def wait(self, finished: Callable[[], bool]) -> None:
        assert self.happens(finished, PATIENCE), 'it did not happen'

    def happens(self, finished: Callable[[], bool], timeout: float) -> bool:
        end = time.monotonic() + timeout
        while not finished() and time.monotonic() < end:
            self.spinner.once()
        return finished()

    def call(self, name: str) -> Trigger.Response:
        answer = ask(self._calls[name], Trigger.Request(), self.happens)
        assert answer is not None, f'{name} did not answer'
        return answer

    def call_until(self, name: str, accepted: Callable[[Trigger.Response], bool]) -> None:
        self.wait(lambda: accepted(self.call(name)))

    def set(self, **values: float) -> str:
        """Sets parameters together; the reason of a refusal, else an empty string."""
        parameters = [Parameter(name, value=values[name]).to_parameter_msg() for name in values]
        request = SetParametersAtomically.Request(parameters=parameters)
        answer = ask(self._set, request, self.happens)
        assert answer is not None, 'no answer'
        return str(answer.result.reason)

    def mode(self) -> int:
        return self.states[-1].mode if self.states else ControllerState.IDLE

    def begin(self) -> None:
        """Everything in place, started, and tracking."""
        self.poses_on = self.recording = True
        self.announce_model()
        self.call_until('start', lambda answer: answer.success)
        self.wait(lambda: self.mode() == ControllerState.TRACKING)


def _pose(stamp: int, x: float, y: float) -> PoseStamped:
    message = PoseStamped()
    message.header.stamp, message.header.frame_id = to_stamp(stamp), 'world'
    message.pose.position.x, message.pose.position.y = float(x), float(y)
    return message


@pytest.fixture
def make_cell(monkeypatch: pytest.MonkeyPatch) -> Iterator[type[Cell]]:
    """Makes cells that no other test sees: an executor keeps its node in the graph."""
    monkeypatch.setenv('ROS_DOMAIN_ID', own_domain())
    rclpy.init()
    yield Cell
    rclpy.try_shutdown()


@pytest.fixture
def cell(make_cell) -> Cell:
    return make_cell()


@pytest.fixture
def started() -> Iterator[Callable[..., 'subprocess.Popen[str]']]:
    processes = []

    def start(*parameters: str, pose_loss: float = 5.0) -> 'subprocess.Popen[str]':
        # the poses of a test come late on a busy machine; only one test is about that
        # the object stands still, far behind its reference after a second
        given = [*parameters, f'pose_loss:={pose_loss}', 'guard.tracking_error:=1.0']
        options = [option for parameter in given for option in ('-p', parameter)]
        process = subprocess.Popen(
            [sys.executable, '-m', 'push_mpc.node.mpc_node', '--ros-args', *options],
            stderr=subprocess.PIPE,
            text=True,
        )
        processes.append(process)
        return process

    yield start
    for process in processes:
        if process.poll() is None:
            process.kill()
        process.communicate()


def is_zero(command: TwistStamped) -> bool:
    return command.twist.linear.x == 0.0 == command.twist.linear.y


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
    cell.wait(lambda: len(cell.plans) > 0)
    topics = cell.node.get_subscriber_names_and_types_by_node('mpc_node', '/')
    heard = {name for name, _ in topics}
    assert interface.OBJECT_POSE.absolute_name in heard
    assert interface.GROUND_TRUTH.absolute_name not in heard


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
    started(LINE)
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


def shifted(seconds: float) -> Callable[[PoseStamped], None]:
    """Moves the stamp of a message."""

    def spoil(message: PoseStamped) -> None:
        stamp = to_nanoseconds(message.header.stamp) + round(1e9 * seconds)
        message.header.stamp = to_stamp(stamp)

    return spoil


def set_frame(message: PoseStamped) -> None:
    message.header.frame_id = 'camera_optical'


def clear_stamp(message: PoseStamped) -> None:
    message.header.stamp = to_stamp(0)


def clear_quaternion(message: PoseStamped) -> None:
    message.pose.orientation.w = 0.0


def to_millimetres(message: PoseStamped) -> None:
    message.pose.position.x *= 1000.0


def tilt(message: PoseStamped) -> None:
    message.pose.orientation.x = message.pose.orientation.w = 0.5**0.5


def move_away(message: PoseStamped) -> None:
    message.pose.position.x += 0.1


IMPOSSIBLE = {
    'an hour old': (shifted(-3600.0), 's old; are the clocks synchronised?'),
    'a third of a second old': (shifted(-0.3), 's old; are the clocks synchronised?'),
    'from the future': (shifted(0.5), 's in the future'),
    'an hour from the future': (shifted(3600.0), 's in the future'),
    'stamp 0': (clear_stamp, 'its stamp is not set, or is simulated time'),
    'frame': (set_frame, "its frame is 'camera_optical', not 'world'"),
    'zero quaternion': (clear_quaternion, 'norm 0'),
    'tilted': (tilt, 'tilted by 90 degrees'),
    'millimetres': (to_millimetres, 'are these metres?'),
    'elsewhere': (move_away, '100 mm and 0 deg from the start of the plan'),
}


def test_what_cannot_be_never_starts_and_is_named(cell, started) -> None:
    started(LINE, 'require_recorder:=false')
    cell.announce_model()
    cell.poses_on = True
    for spoil, reason in IMPOSSIBLE.values():
        cell.spoil = spoil
        cell.call_until('start', lambda answer, reason=reason: reason in answer.message)
    assert cell.commands == []
    cell.spoil = lambda message: None
    cell.call_until('start', lambda answer: answer.success)


@pytest.mark.parametrize('seconds', [-5.0, -0.3, 0.5, 3600.0])
def test_a_clock_that_jumps_during_the_run_stops_it_with_the_reason(
    cell, started, seconds: float
) -> None:
    started(LINE, pose_loss=0.5)
    cell.begin()
    cell.spoil = shifted(seconds)
    cell.wait(lambda: cell.mode() == ControllerState.STOPPED)
    assert 'are the clocks synchronised?' in cell.states[-1].stop_reason
    cell.wait(lambda: is_zero(cell.commands[-1]))


def test_stamps_of_two_devices_pair(cell, started) -> None:
    started(LINE)
    cell.spoil_tip = shifted(-0.003)
    cell.begin()


@pytest.mark.parametrize(
    ('period', 'tip_period', 'latency', 'tolerance'),
    [(23.7, 4.1, 30.0, 5.0), (33.3, 4.0, 0.0, 5.0), (10.0, 37.0, 12.0, 20.0)],
    ids=['slow cameras', 'at once', 'slow tip'],
)
def test_each_pose_pairs_with_the_nearest_of_the_tip_at_any_rates(
    make_cell, started, period: float, tip_period: float, latency: float, tolerance: float
) -> None:
    """The tip's place tells its time: it wanders along the face by 0.1 mm in each millisecond."""
    cell = make_cell(QoSProfile(depth=100))
    started(LINE, f'poses.pair_tolerance:={1e-3 * tolerance}', 'poses.max_age:=10.0')
    cell.poses_on = True
    cell.wait(lambda: len(cell.states) > 0)
    cell.poses_on = False
    cell.happens(lambda: False, 0.5)
    start = cell.node.get_clock().now().nanoseconds
    count = int(300.0 / tip_period)
    tips = tip_period * np.arange(count) + np.random.default_rng(1).uniform(-1.0, 1.0, count)
    exposures = np.arange(50.0, 250.0, period)
    time.sleep(0.3)
    sent = paired = 0
    for exposure in exposures:
        while sent < len(tips) and tips[sent] <= exposure + latency:
            cell.send_tip(start + round(1e6 * tips[sent]), 1e-4 * (tips[sent] - 150.0))
            sent += 1
        # the object's pose has another way to the node
        cell.happens(lambda: False, 0.05)
        nearest = min(tips[:sent], key=lambda time, at=exposure: abs(time - at))
        stamp = start + round(1e6 * exposure)
        cell.send_object(stamp)
        if abs(nearest - exposure) <= tolerance:
            cell.wait(lambda stamp=stamp: cell.answered(stamp))
            assert cell.states[-1].state[3] == pytest.approx(1e-4 * (nearest - 150.0), abs=1e-9)
            paired += 1
    assert paired > 0.7 * len(exposures)


@pytest.mark.parametrize(
    ('behind', 'told'), [(0.0, ''), (0.08, '80 ms behind'), (-0.5, '500 ms ahead')]
)
def test_an_offset_of_the_drivers_clock_is_told_on_diagnostics(
    cell, started, behind: float, told: str
) -> None:
    """Also one that the gate of poses would let pass as a longer delay."""
    started(LINE, 'require_recorder:=false')
    heard: list[DiagnosticStatus] = []
    cell.node.create_subscription(
        DiagnosticArray, '/diagnostics', lambda array: heard.extend(array.status), 10
    )
    cell.announce_model()
    cell.poses_on = True
    reporting = cell.node.create_timer(0.1, lambda: cell.report_as('/cell: cameras', behind))

    def values() -> dict[str, str]:
        own = [status for status in heard if status.name == '/mpc_node: control']
        return {each.key: each.value for each in own[-1].values} if own else {}

    cell.wait(lambda: float(values().get('way_ms', '0')) > 0.0)
    known = 1e3 * behind
    cell.wait(lambda: abs(float(values()['clock_behind_ms']) - known) < 5.0 + abs(0.1 * known))
    cell.happens(lambda: False, 2.5)
    message = next(each for each in reversed(heard) if each.name == '/mpc_node: control').message
    assert (f'the clock of /cell is {told}'[:28] in message) == bool(told), message
    cell.node.destroy_timer(reporting)


def test_stamps_too_far_apart_are_named(cell, started) -> None:
    started(LINE, 'require_recorder:=false', 'poses.pair_tolerance:=0.001')
    cell.announce_model()
    cell.spoil_tip = shifted(-0.004)
    cell.poses_on = True
    cell.call_until(
        'start', lambda answer: 'the stamps of object and tip differ by' in answer.message
    )


@pytest.mark.parametrize(
    'profile',
    [
        QoSProfile(depth=10),
        QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT),
        QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL),
    ],
    ids=['default', 'sensor data', 'latched'],
)
def test_poses_of_any_quality_of_service_are_heard(make_cell, started, profile) -> None:
    started(LINE)
    make_cell(profile).begin()


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
