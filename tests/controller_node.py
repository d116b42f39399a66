"""A node of the controller as a process of its own; the test is plant, recorder and model."""

import random
import subprocess
import sys
import time
from collections.abc import Callable, Iterator

import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseStamped, TwistStamped
from node_tests import kill_all, own_domain
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider
from push_msgs.msg import ControllerState, Horizon, ModelInfo, NominalTrajectory
from push_msgs.srv import Predict
from push_node import qos
from push_node.ask import ask
from push_node.diagnostics import UNPUBLISHED
from push_node.spin import Spinner
from push_node.stamps import to_nanoseconds, to_stamp
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from std_srvs.srv import Trigger

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
        self.model_id = self.recorder_fault = self.unpublished = ''
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
            status.values = [KeyValue(key=UNPUBLISHED, value=self.unpublished)]
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
def make_cell(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., Cell]]:
    """Makes cells that no other test sees."""
    monkeypatch.setenv('ROS_DOMAIN_ID', own_domain())
    rclpy.init()
    made: list[Cell] = []

    def make(*arguments: QoSProfile) -> Cell:
        made.append(Cell(*arguments))
        return made[-1]

    yield make
    for cell in made:
        cell.spinner.close()
    rclpy.try_shutdown()


@pytest.fixture
def cell(make_cell: Callable[..., Cell]) -> Cell:
    return make_cell()


@pytest.fixture
def started() -> Iterator[Callable[..., 'subprocess.Popen[str]']]:
    """Starts nodes; kills those that still run after the test."""
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
    kill_all(processes)


def is_zero(command: TwistStamped) -> bool:
    return command.twist.linear.x == 0.0 == command.twist.linear.y
