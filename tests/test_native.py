"""The commands of ROS 2 itself, not those of the stand-in, on our packages."""

import importlib.util
import os
import re
import shutil
import signal
import subprocess
from collections.abc import Callable, Iterator
from importlib.metadata import distributions
from pathlib import Path

import pytest
from cell_command import Ended
from push_core.common import flatten
from push_node.interface import PERTURB, RESET, SERVICES, TOPICS
from push_sim.node import node_settings

pytestmark = [
    pytest.mark.processes,
    pytest.mark.skipif(
        importlib.util.find_spec('ros2cli') is None, reason='ros2cli is not installed'
    ),
]
Ros2 = Callable[..., Ended]
PUBLISHED = [topic for topic in TOPICS if 'sim_node' in topic.publishers]
# sent without being asked for
STEADY = [topic for topic in PUBLISHED if topic.rate.endswith('Hz')]
NO_DAEMON = ('--no-daemon', '--spin-time', '3')


@pytest.fixture(scope='module')
def ros2(environment: dict[str, str]) -> Ros2:
    def run(*arguments: str) -> Ended:
        return Ended.of_command(environment, 'ros2', *arguments)

    return run


@pytest.fixture(scope='module')
def sim_node(ros2: Ros2, environment: dict[str, str]) -> Iterator[None]:
    command = ['ros2', 'run', 'push_sim', 'sim_node', '--ros-args', '-p', 'seed:=4']
    process = subprocess.Popen(command, env=environment, start_new_session=True)
    try:
        while ros2('topic', 'echo', '--once', '/object_pose').status:
            assert process.poll() is None
        yield
    finally:
        # the real `ros2 run` does not hand the signal on
        os.killpg(process.pid, signal.SIGINT)
        process.wait(timeout=30.0)


def entry_points() -> set[str]:
    return {
        f'{distribution.name.replace("-", "_")} {each.name}'
        for distribution in distributions()
        for each in distribution.entry_points
        if distribution.name.startswith('push') and each.group == 'console_scripts'
    }


def test_it_is_not_the_stand_in() -> None:
    path = Path(str(shutil.which('ros2')))
    assert 'Stands in' not in path.read_text(encoding='utf-8')


def test_pkg_executables_lists_every_command(ros2: Ros2) -> None:
    listed = set(ros2('pkg', 'executables').out.splitlines())
    assert {line for line in listed if line.startswith('push_')} == entry_points()


def test_run_hands_on_arguments_and_status(ros2: Ros2) -> None:
    assert 'usage' in ros2('run', 'push_bringup', 'cell', '--help').out
    assert ros2('run', 'push_bringup', 'cell', '--track', 'none.csv').status == 2


def test_topic_list_names_every_topic_with_its_type(sim_node: None, ros2: Ros2) -> None:
    listed = ros2('topic', 'list', '-t', *NO_DAEMON).out.splitlines()
    ours = [t for t in PUBLISHED if t.name != '/clock']
    assert {f'{topic.absolute_name} [{topic.type_name}]' for topic in ours} <= set(listed)


@pytest.mark.parametrize('topic', STEADY, ids=lambda topic: topic.short_name)
def test_topic_info_and_echo(sim_node: None, ros2: Ros2, topic) -> None:
    told = ros2('topic', 'info', '--verbose', topic.absolute_name, *NO_DAEMON).out
    assert f'Reliability: {topic.qos.reliability.name}' in told
    assert f'Durability: {topic.qos.durability.name}' in told
    echoed = ros2('topic', 'echo', '--once', '--timeout', '30', topic.absolute_name)
    assert (echoed.status, 'stamp:' in echoed.out) == (0, True)


def test_topic_hz_measures_the_rate(sim_node: None, environment: dict[str, str]) -> None:
    command = ['timeout', '-s', 'INT', '10', 'ros2', 'topic', 'hz', '/pusher_pose']
    out = Ended.of_command(environment, *command).out
    rates = [float(rate) for rate in re.findall(r'average rate: ([\d.]+)', out)]
    assert max(rates) == pytest.approx(100.0, abs=10.0)


def test_service_calls(sim_node: None, ros2: Ros2) -> None:
    listed = ros2('service', 'list', '-t', *NO_DAEMON).out.splitlines()
    ours = [each for each in SERVICES if each.server == 'sim_node']
    assert {f'/{each.name} [{each.type_name}]' for each in ours} <= set(listed)
    request = '{object_pose: [0.1, 0, 0], tip_position: [0.05, 0]}'
    answer = ros2('service', 'call', f'/{RESET.name}', RESET.type_name, request)
    assert "success=True, message='at rest'" in answer.out
    refused = ros2('service', 'call', f'/{PERTURB.name}', PERTURB.type_name, '{kind: 9}')
    assert 'success=False' in refused.out


def test_param_lists_gets_describes_and_does_not_set(sim_node: None, ros2: Ros2) -> None:
    settings = flatten(node_settings('irb120'))
    listed = {line.strip() for line in ros2('param', 'list', '/sim_node').out.splitlines()}
    assert set(settings) <= listed
    assert ros2('param', 'get', '/sim_node', 'seed').out == 'Integer value is: 4\n'
    described = ros2('param', 'describe', '/sim_node', 'sensor.latency').out
    _, about = settings['sensor.latency']
    assert (about.text in described, about.range_text() in described) == (True, True)
    assert 'read-only' in ros2('param', 'set', '/sim_node', 'seed', '5').err


def test_a_dump_of_the_parameters_starts_the_node(
    sim_node: None, ros2: Ros2, tmp_path: Path, environment: dict[str, str]
) -> None:
    dump = tmp_path / 'dump.yaml'
    dump.write_text(ros2('param', 'dump', '/sim_node').out)
    command = ['ros2', 'run', 'push_sim', 'sim_node', '--ros-args', '--params-file', str(dump)]
    with subprocess.Popen(
        command, env=environment, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        assert process.stderr is not None
        first = process.stderr.readline()
        os.killpg(process.pid, signal.SIGINT)
    assert 'irb120, realtime' in first


def test_node_info_lists_the_services(sim_node: None, ros2: Ros2) -> None:
    told = ros2('node', 'info', '/sim_node', *NO_DAEMON).out
    assert f'/{RESET.name}: {RESET.type_name}' in told
