"""Plant and controller on two machines, for which two network namespaces stand.

A program in user space carries the frames between them (tools/slow_link.py), since few kernels
have netem. The lap is in real time and judged against the limits that docs/two_machines.md states.
"""

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest
from cell_command import HANG, wait_until_ended
from mcap_ros2.reader import read_ros2_messages
from push_bag.run.series import RunSeries
from push_bag.score.score import score_series

pytestmark = [
    pytest.mark.processes,
    pytest.mark.skipif(os.geteuid() != 0, reason='network namespaces need root'),
    pytest.mark.skipif(shutil.which('ip') is None, reason='needs iproute2'),
    pytest.mark.skipif(not Path('/dev/net/tun').exists(), reason='the kernel has no TAP devices'),
]

TOOL = Path(__file__).parent / 'tools' / 'slow_link.py'
PLANT, CONTROL = f'plant{os.getpid()}', f'control{os.getpid()}'
ACROSS = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET', 'FASTDDS_BUILTIN_TRANSPORTS': 'UDPv4'}
LARGEST_ERROR = 1.2e-3  # [m]; of a circle in one process 0.3 mm, in real time on busy cores more


def ip(*words: str) -> None:
    subprocess.run(['ip', *words], check=True, capture_output=True)


@contextmanager
def machines(*link: str) -> Iterator[None]:
    """Two namespaces with a link of some delay and loss between them."""
    with ExitStack() as stack:
        for name in (PLANT, CONTROL):
            try:
                ip('netns', 'add', name)
            except subprocess.CalledProcessError as error:
                pytest.skip(f'no network namespaces here: {error.stderr.decode().strip()}')
            stack.callback(ip, 'netns', 'del', name)
        carrier = subprocess.Popen(
            [sys.executable, str(TOOL), PLANT, CONTROL, *link], stdout=subprocess.PIPE
        )
        stack.callback(carrier.wait)
        stack.callback(carrier.kill)
        assert carrier.stdout is not None
        assert carrier.stdout.readline() == b'ready\n'
        for number, name in enumerate((PLANT, CONTROL), 1):
            ip('-n', name, 'address', 'add', f'10.77.0.{number}/24', 'dev', 'wire')
            ip('-n', name, 'link', 'set', 'dev', 'lo', 'up')
            ip('-n', name, 'link', 'set', 'dev', 'wire', 'up')
            ip('-n', name, 'route', 'add', '224.0.0.0/4', 'dev', 'wire')
        yield


@contextmanager
def node(environment: dict[str, str], machine: str, module: str, *words: str) -> Iterator[None]:
    """A node on one of the machines."""
    command = ['ip', 'netns', 'exec', machine, sys.executable, '-m', module, '--ros-args']
    options = [option for word in words for option in ('-p', word)]
    process = subprocess.Popen([*command, *options], env=environment | ACROSS)
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(timeout=HANG)


def pushed(environment: dict[str, str], folder: Path) -> RunSeries:
    """A circle, plant on one machine, controller, model and recorder on the other."""
    given = ('controller:=analytical', 'track:=circle', 'pose_loss:=10.0')
    with (
        node(environment, PLANT, 'push_sim.node.sim_node'),
        node(environment, CONTROL, 'push_gp.server.gp_server'),
        node(environment, CONTROL, 'push_bag.record.recorder', f'folder:={folder}'),
        node(environment, CONTROL, 'push_mpc.node.mpc_node', *given),
    ):
        time.sleep(5.0)
        start = ['ip', 'netns', 'exec', CONTROL, sys.executable, '-m']
        subprocess.run(
            [*start, 'push_bringup.commands.start'], env=environment | ACROSS, check=True
        )
        return wait_until_ended(folder)


def measured(folder: Path) -> tuple[float, float]:
    """The way and the offset of the clocks [ms] as the controller told them last."""
    (bag,) = folder.glob('*.mcap')
    told = [
        {each.key: each.value for each in status.values}
        for message in read_ros2_messages(bag, topics=['/diagnostics'])
        for status in message.ros_msg.status
        if status.name == '/mpc_node: control'
    ]
    return float(told[-1]['way_ms']), float(told[-1]['clock_behind_ms'])


@pytest.mark.parametrize(
    ('link', 'lossless', 'way'),
    [
        (('--delay', '0.2'), True, (0.2, 3.0)),
        (('--delay', '5', '--jitter', '2', '--loss', '0.5'), False, (3.0, 8.0)),
    ],
    ids=['0.2 ms', '5 ms, jitter, loss'],
)
def test_a_lap_over_a_network_is_completed_and_tells_the_way(
    environment: dict[str, str],
    tmp_path: Path,
    link: tuple[str, ...],
    lossless: bool,
    way: tuple[float, float],
) -> None:
    with machines(*link):
        run = pushed(environment, tmp_path / 'run')
    if run.stop_reason:
        pytest.skip(f'the machine is too busy for a run in real time: {run.stop_reason}')
    score = score_series(run)
    told, offset = measured(tmp_path / 'run')
    assert way[0] <= told <= way[1]
    assert abs(offset) < 5.0
    assert score['completed']
    assert 1e-3 * score['tracking_error_mm']['mean'] < LARGEST_ERROR
    if lossless:
        assert score['messages']['/pusher_velocity_cmd']['lost'] == 0
