"""A robot in place of the simulator: the contract, and a lap from where the object lies."""

import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from cell_command import Ended, wait_until_ended
from node_tests import own_domain
from push_bag.replay.recompute import Changes, recomputed
from push_bag.run.run_reader import read_run
from push_bag.score.score import score_series

pytestmark = pytest.mark.processes

DRIVER = Path(__file__).parents[1] / 'examples' / 'robot_driver.py'
SIM_NODE = ('-m', 'push_sim.node.sim_node')
Check = Callable[..., Ended]


@pytest.fixture(scope='module')
def environment(environment: dict[str, str]) -> dict[str, str]:
    """A domain in which no node of another test can take commands."""
    return {**environment, 'ROS_DOMAIN_ID': own_domain()}


@contextmanager
def running(environment: dict[str, str], *arguments: str) -> Iterator[None]:
    process = subprocess.Popen([sys.executable, *arguments], env=environment)
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=30.0) == 0


@pytest.fixture
def check(environment: dict[str, str]) -> Check:
    def run(*arguments: str) -> Ended:
        command = ('ros2', 'run', 'push_bringup', 'check_driver', '--move', *arguments)
        return Ended.of_command(environment, *command)

    return run


@pytest.mark.parametrize('driver', [SIM_NODE, (str(DRIVER),)], ids=['simulator', 'example'])
def test_it_keeps_the_contract(environment: dict[str, str], check: Check, driver) -> None:
    with running(environment, *driver):
        ended = check()
    assert (ended.status, 'FAILED' in ended.out) == (0, False), ended.out
    assert 'ok          stops without commands' in ended.out


@pytest.mark.parametrize(
    ('sound', 'broken', 'points'),
    [
        ("'world'", "'camera'", ['object_pose frame, units, age']),
        ('planar[:2])', '1e3 * planar[:2])', ['pusher_pose frame, units, age']),
        ('EXPOSURE = 0.004, 0.01', 'EXPOSURE = 0.004, 0.1', ['object_pose rate']),
        ('> WATCHDOG', '> 1e9', ['stops without commands', 'stops in time']),
        ('[linear.x, linear.y]', '[linear.y, linear.x]', ['moves as commanded']),
        ("'pusher_velocity_cmd'", "'cmd'", ['pusher_velocity_cmd is taken']),
    ],
)
def test_a_broken_driver_is_named(
    environment: dict[str, str],
    check: Check,
    tmp_path: Path,
    sound: str,
    broken: str,
    points: list[str],
) -> None:
    source = DRIVER.read_text(encoding='utf-8')
    assert sound in source
    (tmp_path / 'driver.py').write_text(source.replace(sound, broken), encoding='utf-8')
    with running(environment, str(tmp_path / 'driver.py')):
        ended = check()
    assert ended.status == 1
    for point in points:
        assert f'FAILED      {point}:' in ended.out


def test_nothing_moves_while_another_node_commands(
    environment: dict[str, str], check: Check
) -> None:
    with running(environment, *SIM_NODE), running(environment, '-m', 'push_mpc.node.mpc_node'):
        ended = check()
    assert 'FAILED      nobody else commands: 1 other nodes' in ended.out
    assert 'not tested  motion: a point above must be kept first' in ended.out


def test_a_robot_pushes_a_lap_from_where_the_object_lies(
    environment: dict[str, str],
    by_hand: Callable[..., 'subprocess.Popen[bytes]'],
    tmp_path: Path,
) -> None:
    """Its cameras and its arm have rates and delays of their own, and it has no reset."""
    lag = ('-p', 'actuator.dead_time:=0.04', '-p', 'actuator.lag:=0.03')
    here = ('-p', 'start_from:=here', '-p', 'track:=circle', '-p', 'pose_loss:=10.0')
    with running(environment, str(DRIVER)):
        by_hand('push_gp', 'gp_server')
        by_hand('push_bag', 'recorder', '-p', 'folder:=run')
        by_hand('push_mpc', 'mpc_node', *here, *lag, '-p', 'controller:=analytical')
        started = Ended.of_command(environment, 'ros2', 'run', 'push_bringup', 'start')
        assert started.status == 0, started.err
        run = wait_until_ended(tmp_path / 'run')
    if run.stop_reason.startswith(('no pose', 'the pusher is')):
        pytest.skip(f'the machine is too busy for a run in real time: {run.stop_reason}')
    assert run.stop_reason == ''
    assert run.reference is not None
    assert run.reference.pose[0] == pytest.approx([0.05, -0.03, 0.4], abs=1e-3)
    score = score_series(run)
    assert score['completed']
    assert score['tracking_error_mm']['mean'] < 5.0
    if not any(each['lost'] for each in score['messages'].values()):
        again = recomputed(tmp_path / 'run', Changes())
        # nobody counts the poses of this driver that the recorder, on busy cores, did not get
        assert again.same or again.skipped


def test_a_cell_begins_where_the_simulator_put_the_object(run_cell: Callable[..., Ended]) -> None:
    chosen = ('--mode', 'lockstep', '--track', 'line', '--controller', 'analytical')
    place = ('-p', 'start.x:=-0.1', '-p', 'start.y:=0.2', '-p', 'start.theta:=-1.0')
    run = run_cell(*chosen, '--start', 'here', *place)
    assert run.status == 0, run.err
    recorded = read_run(run.folder)
    assert recorded.reference is not None
    assert recorded.reference.pose[0] == pytest.approx([-0.1, 0.2, -1.0], abs=0.005)
    assert recomputed(run.folder, Changes()).same
