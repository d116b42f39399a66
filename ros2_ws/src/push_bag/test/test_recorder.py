"""The recorder over DDS, against a publisher that counts its messages."""

import re
import signal
import subprocess
import sys
import time

import pytest
import rclpy
from node_tests import kill_all
from push_bag.file.message_types import message_class
from push_bag.file.reader import BagReader
from push_bag.record.recorder import open_bag
from push_bag.record.recorder_settings import RecorderSettings
from push_bag.repair.recover import recover
from push_core.common.errors import InputError
from push_node import interface
from push_node.diagnostics import OK, UNPUBLISHED, WARN
from push_node.interface import TOPICS
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

pytestmark = pytest.mark.processes

PATIENCE = 60.0  # [s]; nothing but a hang takes that long
BEST_EFFORT = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
ROUNDS = 40  # of messages, so few that all may wait for a recorder that gets no core
CORE = [topic for topic in TOPICS if topic.core]


class Cell(Node):
    """Publishes the core topics of a cell."""

    def __init__(self):
        super().__init__('cell')
        self.outlets = {
            topic.name: self.create_publisher(
                message_class(topic.type_name), topic.name, topic.qos
            )
            for topic in CORE
        }

    def send(self, name):
        outlet = self.outlets[name]
        outlet.publish(outlet.msg_type())

    def send_rounds(self, number):
        for _ in range(number):
            for topic in CORE:
                self.send(topic.name)
            time.sleep(0.003)

    def is_heard(self):
        return all(outlet.get_subscription_count() for outlet in self.outlets.values())


@pytest.fixture
def cell():
    rclpy.init()
    node = Cell()
    yield node
    node.destroy_node()
    rclpy.shutdown()


@pytest.fixture
def start():
    """Starts recorders; kills those that still run after the test."""
    started = []

    def start_recorder(*parameters, before=(), namespace='/'):
        command = [*before, sys.executable, '-m', 'push_bag.record.recorder', '--ros-args']
        command += ['-r', f'__ns:={namespace}']
        process = subprocess.Popen(
            [*command, *(word for parameter in parameters for word in ('-p', parameter))],
            stderr=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        return process

    yield start_recorder
    kill_all(started)


def wait_until(condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, 'waited in vain'
        time.sleep(0.02)


def recorded_so_far(folder, topic):
    try:
        return [each.data for each in BagReader(folder).records([topic])]
    except InputError:  # nothing was flushed yet
        return []


def longer_than(bag, size):
    return lambda: bag.stat().st_size > size


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM], ids=['SIGINT', 'SIGTERM'])
def test_every_message_is_recorded_and_a_signal_finishes_the_bag(cell, start, tmp_path, number):
    folder, facts = tmp_path / 'run', tmp_path / 'facts.json'
    facts.write_text('{"profile": "irb120", "seed": 3}')
    recorder = start(f'folder:={folder}', f'facts_file:={facts}', f'attachments:={facts}')
    wait_until(cell.is_heard)
    cell.send_rounds(ROUNDS)
    recorder.send_signal(number)
    _, errors = recorder.communicate(timeout=PATIENCE)
    assert recorder.returncode == 0, errors
    assert re.search(r'recorder: 0 of \d+ messages lost', errors)
    assert 'UserWarning' not in errors
    reader = BagReader(folder)
    counts = dict.fromkeys((f'/{topic.name}' for topic in CORE), 0)
    for record in reader.records(counts):
        counts[record.topic.name] += 1
        assert record.publish_ns <= record.log_ns < record.publish_ns + 1e9 * PATIENCE
    assert counts == dict.fromkeys(counts, ROUNDS)
    assert reader.facts == {'profile': 'irb120', 'seed': '3'}
    assert reader.attachments == {'facts.json': facts.read_bytes()}
    assert reader.finished
    assert set(reader.middleware_lost) >= set(counts)
    assert (folder / 'metadata.yaml').exists()


def test_a_full_disk_ends_the_recorder_with_status_1_and_one_line(cell, start, tmp_path):
    recorder = start(f'folder:={tmp_path / "run"}', before=['prlimit', '--fsize=20000'])
    wait_until(cell.is_heard)
    while recorder.poll() is None:
        cell.send_rounds(1)
    errors = recorder.communicate(timeout=PATIENCE)[1].splitlines()
    assert recorder.returncode == 1
    assert 'recording stopped, what was recorded stays readable' in errors[-1]
    assert sum(1 for _ in BagReader(tmp_path / 'run').records()) > 0


def test_a_run_waits_for_the_parameters_of_nodes_that_were_started_by_hand(cell, start, tmp_path):
    reports = []

    def hear(array):
        reports.extend(each.message for each in array.status if 'recording' in each.name)

    interface.DIAGNOSTICS.subscription(cell, hear)
    spinner = SingleThreadedExecutor()
    spinner.add_node(cell)

    def heard(message):
        spinner.spin_once(timeout_sec=0.1)
        return message in reports

    controller = Node('mpc_node')
    try:
        controller.declare_parameter('horizon', 7)
        recorder = start(f'folder:={tmp_path / "run"}')
        wait_until(lambda: heard('parameters of mpc_node not yet read'))
        reports.clear()
        spinner.add_node(controller)
        wait_until(lambda: heard('recording'))
        recorder.send_signal(signal.SIGINT)
        recorder.communicate(timeout=PATIENCE)
    finally:
        controller.destroy_node()
    reader = BagReader(tmp_path / 'run')
    list(reader.records())
    assert b'horizon: 7' in reader.attachments['params.yaml']


def test_a_wrong_parameter_is_one_line_and_status_2(start, tmp_path):
    recorder = start(f'folder:={tmp_path}')
    errors = recorder.communicate(timeout=PATIENCE)[1]
    assert recorder.returncode == 2
    assert errors.count('\n') == 1
    assert 'exists already' in errors


def test_all_its_nodes_are_in_its_namespace(cell, start, tmp_path):
    start(f'folder:={tmp_path / "run"}', namespace='/left')
    wait_until(lambda: ('recorder_listener', '/left') in cell.get_node_names_and_namespaces())
    wait_until(lambda: ('recorder', '/left') in cell.get_node_names_and_namespaces())
    assert {name for name, place in cell.get_node_names_and_namespaces() if place == '/'} == {
        cell.get_name()
    }


def test_topics_that_appear_later_are_recorded_by_pattern(cell, start, tmp_path):
    start(f'folder:={tmp_path / "run"}', "topics:='/arm/*'")
    wait_until(cell.is_heard)
    late = cell.create_publisher(String, '/arm/joint', 10)
    wait_until(late.get_subscription_count)
    late.publish(String(data='here'))
    wait_until(lambda: recorded_so_far(tmp_path / 'run', '/arm/joint'))
    (data,) = recorded_so_far(tmp_path / 'run', '/arm/joint')
    assert data[8:12] == b'here'


def test_a_publisher_that_offers_a_weaker_qos_than_the_first_is_recorded(cell, start, tmp_path):
    start(f'folder:={tmp_path / "run"}', 'topics:=/arm/joint')
    first = cell.create_publisher(String, '/arm/joint', 10)
    wait_until(first.get_subscription_count)
    second = cell.create_publisher(String, '/arm/joint', BEST_EFFORT)
    wait_until(second.get_subscription_count)

    def both_are_there():
        first.publish(String(data='one!'))
        second.publish(String(data='two!'))
        texts = {data[8:12] for data in recorded_so_far(tmp_path / 'run', '/arm/joint')}
        return texts == {b'one!', b'two!'}

    wait_until(both_are_there)


def test_it_tells_which_publishers_are_gone_until_others_are_heard(cell, start, tmp_path):
    told = []

    def keep(array):
        values = {each.key: each.value for each in array.status[0].values}
        told.append((array.status[0].level, values.get(UNPUBLISHED)))

    def tells(*status):
        rclpy.spin_once(cell, timeout_sec=0.1)
        return told[-1:] == [status]

    interface.DIAGNOSTICS.subscription(cell, keep)
    start(f'folder:={tmp_path / "run"}')
    wait_until(lambda: tells(OK, ''))
    pose = CORE[0]
    cell.destroy_publisher(cell.outlets.pop(pose.name))
    wait_until(lambda: tells(WARN, f'/{pose.name}'))
    cell.outlets[pose.name] = pose.publisher(cell)
    wait_until(lambda: tells(OK, ''))


def test_a_killed_recording_is_recovered_without_a_hole(cell, start, tmp_path):
    recorder = start(f'folder:={tmp_path / "run"}')
    wait_until(cell.is_heard)
    (bag,) = (tmp_path / 'run').glob('*.mcap')
    for _ in range(3):
        cell.send_rounds(ROUNDS)
        wait_until(longer_than(bag, bag.stat().st_size))
    cell.send_rounds(ROUNDS)
    recorder.kill()
    recorder.wait()
    found = recover(tmp_path / 'run', tmp_path / 'saved')
    numbers = [each.sequence for each in BagReader(tmp_path / 'saved').records(['/object_pose'])]
    assert numbers == list(range(1, len(numbers) + 1))
    assert 2 * ROUNDS <= len(numbers) <= 4 * ROUNDS
    assert 'cut short' in found.text()


@pytest.mark.parametrize(
    ('settings', 'reason'),
    [
        ({'folder': '/dev/null/run'}, 'cannot be created: Not a directory'),
        ({}, 'name the new folder'),
        ({'facts_file': 'none.json'}, 'No such file'),
        ({'facts_file': __file__}, 'is not JSON'),
        ({'attachments': 'none.yaml'}, 'No such file'),
    ],
    ids=[
        'no place for a folder',
        'no folder',
        'no facts',
        'facts of another kind',
        'no attachment',
    ],
)
def test_a_wrong_setting_leaves_nothing_behind(tmp_path, settings, reason):
    folder = str(tmp_path / 'run') if settings else ''
    with pytest.raises(InputError, match=reason):
        open_bag(RecorderSettings(**{'folder': folder, **settings}))
    assert list(tmp_path.iterdir()) == []
