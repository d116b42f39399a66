"""A robot in place of the simulator: the contract, and a lap from where the object lies."""

import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from cell_command import Ended

pytestmark = pytest.mark.processes

DRIVER = Path(__file__).parents[1] / 'examples' / 'robot_driver.py'
SIM_NODE = ('-m', 'push_sim.node.sim_node')
Check = Callable[..., Ended]


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
