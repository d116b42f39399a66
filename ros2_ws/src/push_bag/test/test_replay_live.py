"""A replay beside running nodes: it moves no plant and is no second source."""

from collections.abc import Callable, Iterator

import pytest
import rclpy
from geometry_msgs.msg import PoseStamped, TwistStamped
from node_tests import own_domain
from push_bag.commands import replay
from push_bag.commands.replay import main
from push_node import qos
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

pytestmark = pytest.mark.processes

COMMANDS = 'pusher_velocity_cmd'


@pytest.fixture
def neighbour(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[str], Node]]:
    """Makes nodes in a context of their own, as another process does, in a domain of their own."""
    monkeypatch.setenv('ROS_DOMAIN_ID', own_domain())
    context, nodes = Context(), []
    rclpy.init(context=context)

    def make(name: str) -> Node:
        nodes.append(Node(name, context=context))
        return nodes[-1]

    yield make
    for node in nodes:
        node.destroy_node()
    context.try_shutdown()


@pytest.fixture
def replayed(perfect, capfd) -> Callable[..., tuple[int, str, str]]:
    def run(*words: str) -> tuple[int, str, str]:
        status = main([str(perfect), '--rate', '20', '--delay', '0.2', *words])
        output, errors = capfd.readouterr()
        return status, output, errors

    return run


def plant(neighbour) -> Node:
    node = neighbour('driver')
    node.create_subscription(TwistStamped, COMMANDS, lambda message: None, qos.COMMAND)
    return node


def published_topics(output: str) -> int:
    return int(output.split(' messages on ')[1].split(maxsplit=1)[0])


def test_commands_are_left_out_unless_asked_for(neighbour, replayed) -> None:
    plant(neighbour)
    status, without, _ = replayed()
    assert status == 0
    status, with_commands, _ = replayed('--with-commands', '--drive')
    assert status == 0
    assert published_topics(with_commands) == published_topics(without) + 1


def test_commands_never_reach_a_plant_without_a_further_word(neighbour, replayed) -> None:
    plant(neighbour)
    status, _, errors = replayed('--with-commands')
    assert status == 2
    assert '/driver would execute /pusher_velocity_cmd and move' in errors
    assert 'add --drive' in errors


def test_a_plant_that_is_found_late_gets_no_command(neighbour, replayed, monkeypatch) -> None:
    """As on busy cores, where discovery takes longer than the replay waits."""
    monkeypatch.setattr(replay, 'check_graph', lambda *_: None)
    driver, heard = neighbour('driver'), []
    driver.create_subscription(TwistStamped, COMMANDS, heard.append, qos.COMMAND)
    status, _, errors = replayed('--with-commands', '--delay', '1')
    assert status == 2
    assert '/driver would execute /pusher_velocity_cmd and move' in errors
    executor = SingleThreadedExecutor(context=driver.context)
    executor.add_node(driver)
    executor.spin_once(timeout_sec=0.5)
    assert heard == []


def test_a_recorder_does_not_execute_commands(neighbour, replayed) -> None:
    listener = neighbour('recorder_listener')
    listener.create_subscription(TwistStamped, COMMANDS, lambda message: None, qos.COMMAND)
    assert replayed('--with-commands')[0] == 0


@pytest.mark.parametrize(
    ('kind', 'topic', 'words'),
    [
        (PoseStamped, 'object_pose', ()),
        (PoseStamped, 'pusher_pose', ('--topics', 'pusher_pose')),
        (TwistStamped, COMMANDS, ('--with-commands', '--drive')),
    ],
)
def test_it_is_no_second_source(neighbour, replayed, kind, topic, words) -> None:
    other = neighbour('sim_node')
    other.create_publisher(kind, topic, qos.COMMAND)
    status, _, errors = replayed(*words)
    assert status == 2
    assert f'/{topic} is published by /sim_node' in errors


def test_other_topics_play_beside_running_nodes(neighbour, replayed) -> None:
    other = neighbour('sim_node')
    other.create_publisher(PoseStamped, 'object_pose', qos.POSE)
    assert replayed('--topics', 'controller_state')[0] == 0


@pytest.mark.parametrize(
    ('words', 'reason'),
    [
        (['--drive'], '--drive needs --with-commands'),
        (['--topics', COMMANDS], 'commands are published only with --with-commands'),
    ],
)
def test_options_that_lack_another_are_refused(perfect, capsys, words, reason) -> None:
    assert main([str(perfect), *words]) == 2
    assert reason in capsys.readouterr().err
