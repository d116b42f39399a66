"""Independent readers read what was written."""

from collections import Counter

import numpy as np
import pytest
import rclpy
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from push_bag.file.bag_writer import BagWriter
from push_bag.file.message_types import message_class, type_hash
from push_bag.file.qos_text import qos_text
from push_bag.file.reader import BagReader
from push_bag.run.run_reader import read_run
from push_node.interface import TOPICS
from rclpy.serialization import serialize_message
from rosbags.highlevel import AnyReader
from rosbags.interfaces import QosDurability, QosReliability
from rosbags.typesys import Stores, get_typestore


@pytest.fixture(scope='module')
def ours(perfect):
    reader = BagReader(perfect)
    counts = Counter(record.topic.name for record in reader.records())
    return reader, counts, read_run(perfect)


def test_rosbags_reads_every_message_of_every_topic(perfect, ours):
    _, counts, run = ours
    theirs, poses = Counter(), []
    with AnyReader([perfect]) as bag:
        for connection, _, data in bag.messages():
            message = bag.deserialize(data, connection.msgtype)
            theirs[connection.topic] += 1
            if connection.topic == '/object_pose':
                poses.append([message.pose.position.x, message.pose.position.y])
        stated = {each.topic: each.msgcount for each in bag.connections if each.msgcount}
    assert theirs == counts == stated
    np.testing.assert_array_equal(poses, run.object.values[:, :2])


def test_rosbags_finds_the_offered_qos(perfect):
    with AnyReader([perfect]) as bag:
        offers = {each.topic: each.ext.offered_qos_profiles[0] for each in bag.connections}
    assert offers['/object_pose'].reliability == QosReliability.BEST_EFFORT
    assert offers['/object_pose'].deadline.nsec == 20_000_000
    assert offers['/model_info'].durability == QosDurability.TRANSIENT_LOCAL


def test_mcap_ros2_support_reads_every_message_of_every_topic(ours):
    reader, counts, run = ours
    theirs, plans = Counter(), []
    with reader.path.open('rb') as stream:
        bag = make_reader(stream, decoder_factories=[DecoderFactory()])
        for _, channel, _, message in bag.iter_decoded_messages():
            theirs[channel.topic] += 1
            if channel.topic == '/nominal_trajectory':
                plans.append(message.x)
    assert theirs == counts
    np.testing.assert_array_equal(plans[0], run.reference.pose[:, 0])


def test_the_index_holds_statistics_facts_and_attachments(ours):
    reader, counts, _ = ours
    with reader.path.open('rb') as stream:
        bag = make_reader(stream, validate_crcs=True)
        profile = bag.get_header().profile
        summary = bag.get_summary()
        facts = {record.name: record.metadata for record in bag.iter_metadata()}
        attached = {record.name: record.data for record in bag.iter_attachments()}
    assert profile == 'ros2'
    assert summary.statistics.message_count == counts.total()
    assert len(summary.chunk_indexes) > 1
    assert facts['run']['profile'] == 'irb120'
    assert attached == {'params.yaml': b'a: 1\n'}


def test_facts_and_attachments_come_before_the_first_message(perfect):
    reader = BagReader(perfect)
    next(reader.records())
    assert reader.facts['seed'] == '7'
    assert reader.attachments == {'params.yaml': b'a: 1\n'}


def test_type_hashes_are_those_of_the_installed_ros(perfect):
    reader = BagReader(perfect)
    list(reader.records())
    rclpy.init(domain_id=101)
    node = rclpy.create_node('hashes')
    try:
        for topic in reader.topics.values():
            node.create_publisher(message_class(topic.type_name), topic.name, 1)
            (info,) = node.get_publishers_info_by_topic(topic.name)
            assert topic.type_hash == str(info.topic_type_hash)
    finally:
        node.destroy_node()
        rclpy.shutdown()


def test_the_hash_of_tf_is_that_which_ros_publishes():
    """Where ROS is installed from wheels, this workspace defines the type."""
    theirs = get_typestore(Stores.ROS2_JAZZY).hash_rihs01('tf2_msgs/msg/TFMessage')
    assert type_hash('tf2_msgs/msg/TFMessage') == theirs


def filled(type_name):
    """A message whose arrays hold two numbers each: rosbags refuses some that are empty."""
    message = message_class(type_name)()
    for name, kind in message.get_fields_and_field_types().items():
        if kind == 'sequence<double>':
            setattr(message, name, [1.0, 2.0])
    return message


def test_others_read_the_type_of_every_topic_of_the_cell(tmp_path):
    with BagWriter(tmp_path / 'run', {}, {}) as bag:
        for topic in TOPICS:
            name = f'/{topic.name.lstrip("/")}'
            bag.add_topic(name, topic.type_name, qos_text(topic.qos))
            bag.write(name, serialize_message(filled(topic.type_name)), 1, 1, 1)
    names = {f'/{topic.name.lstrip("/")}' for topic in TOPICS}
    with AnyReader([tmp_path / 'run']) as bag:
        read = bag.messages()
        decoded = {each.topic: bag.deserialize(data, each.msgtype) for each, _, data in read}
        hashes = {each.topic: each.digest for each in bag.connections}
    assert set(decoded) == names
    for topic in TOPICS:
        assert hashes[f'/{topic.name.lstrip("/")}'] == type_hash(topic.type_name)
    with BagReader(tmp_path / 'run').path.open('rb') as stream:
        bag = make_reader(stream, decoder_factories=[DecoderFactory()])
        assert {channel.topic for _, channel, _, _ in bag.iter_decoded_messages()} == names


def test_nested_types_of_other_packages_are_in_the_bag(tmp_path):
    type_name = 'visualization_msgs/msg/MarkerArray'
    with BagWriter(tmp_path / 'run', {}, {}) as bag:
        bag.add_topic('/scene', type_name, '[]')
        bag.write('/scene', bytes([0, 1, 0, 0, 0, 0, 0, 0]), 1, 1, 1)
    with AnyReader([tmp_path / 'run']) as theirs:
        ((connection, _, data),) = theirs.messages()
        assert theirs.deserialize(data, connection.msgtype).markers == []
        assert connection.digest == type_hash(type_name)


def test_schemas_name_their_parts_as_rosbag2_does(perfect):
    """Foxglove's reader looks types up by the name that the field states."""
    reader = BagReader(perfect)
    list(reader.records())
    schema = reader.topics['/object_pose'].schema
    assert '\n' + '=' * 80 + '\nMSG: std_msgs/Header\n' in schema
    assert '\nMSG: builtin_interfaces/Time\n' in schema
