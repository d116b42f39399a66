"""Columns agree with rclpy's deserializer."""

import random

import numpy as np
import pytest
from push_bag.file.cdr_columns import columns
from push_bag.file.cdr_layout import leaves
from push_bag.file.message_types import message_class, schema_text
from push_core.common.errors import InputError
from rclpy.serialization import deserialize_message, serialize_message

TYPES = (
    'geometry_msgs/msg/PoseStamped',
    'geometry_msgs/msg/TwistStamped',
    'push_msgs/msg/ControllerState',
    'push_msgs/msg/Perturbation',
)


def layout(type_name):
    return leaves(schema_text(type_name), type_name.split('/')[0])


def value(message, path):
    for name in path.split('.'):
        message = getattr(message, name)
    return message


def set_value(message, path, new):
    *owners, name = path.split('.')
    for owner in owners:
        message = getattr(message, owner)
    setattr(message, name, new)


def drawn(leaf, chance):
    """A random value of a field."""
    if leaf.dtype == 'str':
        return 'ä' * chance.randrange(3) + 'x' * chance.randrange(6)
    dtype = np.dtype(leaf.dtype)
    if dtype.kind == 'f':
        numbers = [chance.gauss(0.0, 1e3) for _ in range(leaf.count)]
    else:
        info = np.iinfo(dtype)
        numbers = [chance.randint(int(info.min), int(info.max)) for _ in range(leaf.count)]
    return numbers if leaf.count > 1 else numbers[0]


@pytest.mark.parametrize('type_name', TYPES)
def test_random_messages_are_decoded_as_rclpy_decodes_them(type_name):
    chance, kind, fields = random.Random(0), message_class(type_name), layout(type_name)
    messages = []
    for _ in range(60):
        message = kind()
        for leaf in fields:
            set_value(message, leaf.name, drawn(leaf, chance))
        messages.append(serialize_message(message))
    found = columns(messages, fields, [leaf.name for leaf in fields])
    for row, data in enumerate(messages):
        decoded = deserialize_message(data, kind)
        for leaf in fields:
            np.testing.assert_array_equal(found[leaf.name][row], value(decoded, leaf.name))


def test_fields_before_a_list_are_found_and_those_behind_it_refused():
    type_name = 'push_msgs/msg/NominalTrajectory'
    message = message_class(type_name)(track='eight', speed=0.08, laps=3)
    data, fields = serialize_message(message), layout(type_name)
    found = columns([data, data], fields, ('track', 'speed', 'laps'))
    assert [found[name][1] for name in ('track', 'speed', 'laps')] == ['eight', 0.08, 3]
    with pytest.raises(ValueError, match='no fixed size'):
        columns([data], fields, ('v_t',))


@pytest.mark.parametrize('spoil', [lambda data: data[:30], lambda data: b'\0\0' + data[2:]])
def test_bytes_of_another_type_are_refused(spoil):
    type_name = 'geometry_msgs/msg/PoseStamped'
    data = spoil(serialize_message(message_class(type_name)()))
    with pytest.raises(ValueError, match=r'short|CDR'):
        columns([data], layout(type_name), ('pose.position.y',))


def test_a_schema_that_contains_itself_or_lacks_a_part_is_refused():
    with pytest.raises(InputError, match='contains itself'):
        leaves('Loop a\n' + '=' * 80 + '\nMSG: a_msgs/Loop\nLoop again\n', 'a_msgs')
    with pytest.raises(InputError, match='does not define'):
        leaves('std_msgs/Header header\n', 'a_msgs')
