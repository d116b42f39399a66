"""Plant and controller in two network namespaces, which stand for two machines. Needs root.

A program in user space carries the frames between them (slow_link.py); few kernels have netem.
"""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from cell_command import HANG, wait_until_ended
from mcap_ros2.reader import read_ros2_messages
from push_bag.run.series import RunSeries
from push_bringup.graph.node_graph import FAST_DDS_PROFILES
from push_bringup.setup import installed_config

TOOL = Path(__file__).parent / 'slow_link.py'
PLANT, CONTROL = f'plant{os.getpid()}', f'control{os.getpid()}'
ACROSS = {
    'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET',
    'FASTDDS_BUILTIN_TRANSPORTS': 'UDPv4',
    FAST_DDS_PROFILES: str(installed_config('fastdds.xml')),
}


class NoNamespacesError(Exception):
    """The kernel or its owner allows no network namespaces."""


def ip(*words: str) -> None:
    subprocess.run(['ip', *words], check=True, capture_output=True)


@contextmanager
def machines(*link: str) -> Iterator[None]:
    """Two namespaces with a link of some delay and loss between them, options of slow_link.py.

    Raises:
        NoNamespacesError: says what `ip` said.
    """
    with ExitStack() as stack:
        for name in (PLANT, CONTROL):
            try:
                ip('netns', 'add', name)
            except subprocess.CalledProcessError as error:
                raise NoNamespacesError(error.stderr.decode().strip()) from error
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


def pushed(
    environment: dict[str, str], folder: Path, seed: int = 0, track: str = 'circle'
) -> RunSeries:
    """A lap, plant on one machine, controller, model and recorder on the other."""
    given = ('controller:=analytical', f'track:={track}', 'pose_loss:=10.0')
    with (
        node(environment, PLANT, 'push_sim.node.sim_node', f'seed:={seed}'),
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
