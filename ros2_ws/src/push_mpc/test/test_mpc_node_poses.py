"""What the node does with poses: their clocks, frames, rates and quality of service."""

import time
from collections.abc import Callable

import controller_node
import numpy as np
import pytest
from controller_node import LINE, is_zero
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped
from push_msgs.msg import ControllerState
from push_node.stamps import to_nanoseconds, to_stamp
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

pytestmark = pytest.mark.processes

# the fixtures
cell, started = controller_node.cell, controller_node.started
make_cell = controller_node.make_cell


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


@pytest.mark.parametrize('seconds', [-5.0, -0.3, -0.05, 0.5, 3600.0])
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
