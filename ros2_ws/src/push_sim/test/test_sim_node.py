"""The node as a process of its own, over real DDS."""

import math
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped, TwistStamped
from push_core.physics.slider import Slider
from push_msgs.msg import GroundTruth, NominalTrajectory, Perturbation
from push_msgs.srv import Perturb, Reset
from push_node.ask import ask
from push_node.qos import COMMAND, EVENT, LATCHED, POSE, STATE
from push_node.spin import Spinner
from push_node.stamps import to_nanoseconds
from push_sim.plant.plant import Plant
from push_sim.settings.profiles import profile
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import Trigger

pytestmark = pytest.mark.processes

PATIENCE = 60.0  # [s]; nothing but a hang takes that long
OBJECT_POSE = [0.1, -0.2, 0.3]
TIP = Slider().tip_position(np.array(OBJECT_POSE), 0.01).tolist()


class Client:
    """Stands for the controller: keeps what came and sends commands."""

    def __init__(self) -> None:
        self.node = Node('client')
        self._spinner = Spinner(self.node)
        self.poses: list[PoseStamped] = []
        self.perturbations: list[Perturbation] = []
        self.truths: list[GroundTruth] = []
        self.answer: Callable[[PoseStamped], TwistStamped] | None = None
        self._commands = self.node.create_publisher(TwistStamped, 'pusher_velocity_cmd', COMMAND)
        self.node.create_subscription(PoseStamped, 'object_pose', self._on_pose, POSE)
        self.node.create_subscription(
            Perturbation, 'perturbation', self.perturbations.append, EVENT
        )
        self.node.create_subscription(
            GroundTruth, 'push_sim/ground_truth', self.truths.append, STATE
        )
        self.problems: list[str] = []
        self.node.create_subscription(DiagnosticArray, '/diagnostics', self._on_health, 10)
        self._reset = self.node.create_client(Reset, 'push_sim/reset')
        self._perturb = self.node.create_client(Perturb, 'push_sim/perturb')
        self._reset_to_plan = self.node.create_client(Trigger, 'push_sim/reset_to_plan')
        self._set = self.node.create_client(
            SetParametersAtomically, 'sim_node/set_parameters_atomically'
        )
        self._plans = self.node.create_publisher(NominalTrajectory, 'nominal_trajectory', LATCHED)

    def _on_pose(self, message: PoseStamped) -> None:
        self.poses.append(message)
        if self.answer is not None:
            self._commands.publish(self.answer(message))

    def _on_health(self, array: DiagnosticArray) -> None:
        for status in array.status:
            if status.level == DiagnosticStatus.ERROR:
                self.problems.append(status.message)

    def close(self) -> None:
        self._spinner.close()

    def wait(self, finished: Callable[[], bool], timeout: float = PATIENCE) -> None:
        assert self._happens(finished, timeout)

    def _happens(self, finished: Callable[[], bool], timeout: float) -> bool:
        end = time.monotonic() + timeout
        while not finished() and time.monotonic() < end:
            self._spinner.once()
        return finished()

    def reset(self, seed: int = 5, tip: Sequence[float] = TIP) -> Reset.Response:
        request = Reset.Request(seed=seed, object_pose=OBJECT_POSE, tip_position=tip)
        return self._call(self._reset, request)

    def speed(self) -> float:
        """Of the tip [m/s], from its last two true positions."""
        self.truths.clear()
        self.wait(lambda: len(self.truths) >= 2)
        before, after = self.truths[-2:]
        time = to_nanoseconds(after.header.stamp) - to_nanoseconds(before.header.stamp)
        return float(np.hypot(*np.subtract(after.tip, before.tip)) / max(time * 1e-9, 1e-3))

    def set(self, **values: float | str) -> str:
        """Sets parameters together; the reason of a refusal, else an empty string."""
        parameters = [
            Parameter(name, value=value).to_parameter_msg() for name, value in values.items()
        ]
        request = SetParametersAtomically.Request(parameters=parameters)
        return self._call(self._set, request).result.reason

    def announce_plan(self, pose: Sequence[float], p_y: float) -> None:
        x, y, theta = ([value] for value in pose)
        self._plans.publish(NominalTrajectory(track='line', x=x, y=y, theta=theta, p_y=[p_y]))

    def announce_half_a_plan(self) -> None:
        self._plans.publish(NominalTrajectory(track='line', x=[0.1, 0.2], y=[0.1]))

    def reset_to_plan(self) -> Trigger.Response:
        return self._call(self._reset_to_plan, Trigger.Request())

    def perturb(self, **request: float) -> Perturb.Response:
        return self._call(self._perturb, Perturb.Request(**request))

    def _call(self, client, request):
        answer = ask(client, request, self._happens)
        assert answer is not None, f'{client.srv_name} did not answer'
        return answer


@pytest.fixture(scope='module')
def client() -> Iterator[Client]:
    rclpy.init()
    client = Client()
    yield client
    client.close()
    rclpy.try_shutdown()


@pytest.fixture(autouse=True)
def forget(client: Client) -> None:
    client.answer = None
    client.poses.clear()
    client.perturbations.clear()


@contextmanager
def running(*parameters: str) -> Iterator[subprocess.Popen[str]]:
    """A node that ends with the test, also where that fails."""
    arguments = [argument for parameter in parameters for argument in ('-p', parameter)]
    command = [sys.executable, '-m', 'push_sim.node.sim_node', '--ros-args', *arguments]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        yield process
    finally:
        process.kill()
        process.wait()


@pytest.fixture(scope='module')
def lockstep(client: Client) -> Iterator[None]:
    """A node that all lockstep tests share."""
    with running('mode:=lockstep') as process:
        client.wait(lambda: client.node.count_publishers('perturbation') > 0)
        yield
        process.terminate()
        process.communicate(timeout=PATIENCE)


def command(stamp, velocity) -> TwistStamped:
    message = TwistStamped()
    message.header.stamp = stamp
    message.header.frame_id = 'world'
    message.twist.linear.x, message.twist.linear.y = map(float, velocity)
    return message


def age(pose: PoseStamped) -> int:
    return time.time_ns() - to_nanoseconds(pose.header.stamp)


def test_realtime_poses_come_on_a_grid_of_10_ms_until_sigterm(client) -> None:
    with running() as process:
        assert client.reset().success
        client.poses.clear()
        # late wake-ups of a busy machine skip poses, but the plant comes up with the clock again
        client.wait(lambda: len(client.poses) >= 50 and 0 < age(client.poses[-1]) < 500_000_000)
        steps = np.diff([to_nanoseconds(pose.header.stamp) for pose in client.poses])
        assert np.all(steps > 0)
        assert np.all(steps % 10_000_000 == 0)
        assert client.poses[-1].pose.position.x == pytest.approx(OBJECT_POSE[0], abs=1e-3)
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=PATIENCE) == 0
        assert 'Traceback' not in process.communicate()[1]
        client.wait(lambda: client.node.count_publishers('object_pose') == 0)


def test_a_second_source_of_commands_makes_the_driver_brake_and_is_named(client) -> None:
    with running('profile:=ideal') as process:
        assert client.reset().success
        client.answer = lambda pose: command(pose.header.stamp, (0.02, 0.0))
        client.wait(lambda: client.speed() > 0.015)
        teleop = Node('teleop')
        publisher = teleop.create_publisher(TwistStamped, 'pusher_velocity_cmd', COMMAND)
        client.wait(lambda: client.speed() < 1e-6)
        status = 'pusher_velocity_cmd has 2 publishers: /client, /teleop; the driver brakes'
        client.wait(lambda: status in client.problems)
        teleop.destroy_publisher(publisher)
        client.wait(lambda: client.speed() > 0.015)
        process.terminate()
        assert status in process.communicate(timeout=PATIENCE)[1]
        client.wait(lambda: client.node.count_publishers('object_pose') == 0)


def test_lockstep_gives_the_trajectory_of_the_loop_without_dds(client, lockstep, weave) -> None:
    ticks = iter(range(1000))
    answered: dict[int, np.ndarray] = {}

    def answer(pose: PoseStamped) -> TwistStamped:
        stamp = to_nanoseconds(pose.header.stamp)
        if stamp not in answered:
            answered[stamp] = weave(next(ticks))
        return command(pose.header.stamp, answered[stamp])

    assert client.reset().success
    client.wait(lambda: len(client.poses) > 0)
    client.poses.clear()
    client.answer = answer
    client.wait(lambda: len(answered) > 60)

    plant = Plant(profile('irb120'), Slider())
    observation = plant.reset(np.array(OBJECT_POSE), np.array(TIP), 5)
    shown = {to_nanoseconds(pose.header.stamp): pose.pose for pose in client.poses}
    for tick in range(60):
        pose = shown[round(observation.time * 1e9)]
        assert (pose.position.x, pose.position.y) == tuple(observation.object_pose[:2])
        plant.command(weave(tick), plant.time)
        observation = plant.step()


def test_lockstep_waits_and_shows_an_unanswered_pose_again(client, lockstep) -> None:
    assert client.reset().success
    client.poses.clear()
    # what was on its way before the reset may come first
    client.wait(lambda: len(client.poses) >= 5)
    assert len({to_nanoseconds(pose.header.stamp) for pose in client.poses[-3:]}) == 1


def test_a_perturbation_is_applied_and_published(client, lockstep) -> None:
    assert client.reset().success
    client.answer = lambda pose: command(pose.header.stamp, (0.0, 0.0))
    assert client.perturb(kind=Perturbation.NORMAL, magnitude=0.03, angle=0.0).success
    client.wait(lambda: len(client.perturbations) == 1)
    client.wait(lambda: client.poses[-1].pose.position.x > OBJECT_POSE[0] + 0.02)
    moved = client.poses[-1].pose.position.x - OBJECT_POSE[0]
    assert moved == pytest.approx(0.03 * np.cos(OBJECT_POSE[2]), abs=1e-3)
    assert client.perturbations[0].direction.y == pytest.approx(np.sin(OBJECT_POSE[2]), abs=1e-6)


def test_services_refuse_what_cannot_be_done(client, lockstep) -> None:
    assert 'seed' in client.reset(seed=-1).message
    assert 'kind' in client.perturb(kind=9, magnitude=0.01, angle=0.0).message
    assert 'magnitude' in client.perturb(kind=0, magnitude=float('nan'), angle=0.0).message


def test_noise_and_perturbation_change_while_it_runs_and_the_rest_does_not(
    client, lockstep
) -> None:
    assert client.reset().success
    client.answer = lambda pose: command(pose.header.stamp, (0.0, 0.0))
    assert client.set(**{'sensor.position_noise': 0.01}) == ''
    client.poses.clear()
    client.wait(lambda: len(client.poses) >= 50)
    assert np.std([pose.pose.position.x for pose in client.poses[10:]]) > 0.003
    assert client.set(**{'sensor.position_noise': 0.0, 'perturbation.kind': 'normal'}) == ''
    client.wait(lambda: len(client.perturbations) == 1)
    refused = client.set(**{'sensor.position_noise': 0.0, 'sensor.dropout': 1.5})
    assert 'parameter sensor.dropout is 1.5, must be between 0 and 0.9' in refused
    assert client.set(**{'world.friction_ground': 0.5, 'world.friction_pusher': 0.3}) == ''
    assert 'read-only' in client.set(**{'world.mass_error': 0.5})
    assert client.set(**{'perturbation.kind': 'none'}) == ''


def test_a_reset_puts_no_tip_into_the_object(client, lockstep) -> None:
    answer = client.reset(tip=OBJECT_POSE[:2])
    assert not answer.success
    assert 'mm inside the object; the tip touches it 49.75 mm from its centre' in answer.message
    assert client.reset().success


def test_a_reset_to_the_plan_needs_a_plan_and_touches_the_object_at_its_start(
    client, lockstep
) -> None:
    refused = client.reset_to_plan()
    assert not refused.success
    assert 'no plan on nominal_trajectory' in refused.message
    pose, p_y = [0.3, 0.1, -0.4], 0.01
    client.announce_plan(pose, p_y)
    client.wait(lambda: client.reset_to_plan().success)
    client.truths.clear()
    client.wait(lambda: len(client.truths) >= 3)
    truth = client.truths[-1]
    assert truth.pose == pytest.approx(pose, abs=1e-6)
    assert (truth.p_y, truth.gap) == pytest.approx((p_y, 0.0), abs=1e-6)


def test_what_is_no_plan_leaves_the_one_before(client, lockstep) -> None:
    pose, p_y = [0.2, -0.1, 0.3], 0.0
    client.announce_plan(pose, p_y)
    client.wait(lambda: client.reset_to_plan().success)
    client.announce_half_a_plan()
    client.announce_plan([0.2, -0.1, math.inf], p_y)
    assert all(client.reset_to_plan().success for _ in range(5))
    client.truths.clear()
    client.wait(lambda: len(client.truths) >= 3)
    assert client.truths[-1].pose == pytest.approx(pose, abs=1e-6)


def test_a_bad_parameter_fails_the_start_with_one_line_that_names_it() -> None:
    with running('world.substep:=0.003') as process:
        _, errors = process.communicate(timeout=PATIENCE)
        assert process.returncode == 2
        assert errors.count('\n') == 1
        assert 'world.substep' in errors
