"""A topic that cannot be published is left out and named; the others are replayed."""

import pytest
from push_bag.commands.replay import main

pytestmark = pytest.mark.processes

QUICK = ['--delay', '0', '--rate', '100']
STRANGE = ('nowhere_msgs/msg/Wheel', 'ros2msg', b'float64 speed\n')
INT8 = ('std_msgs/msg/Int8', 'ros2msg', b'int8 data\n')


@pytest.fixture
def mixed(bag):
    """Eight topics of which three cannot be published."""
    with bag() as writing:
        good = [writing.channel(f'/good_{number}') for number in range(5)]
        others = [
            writing.channel('/wheel', STRANGE),
            writing.channel('/json', ('p', 'jsonschema', b'{}'), 'json'),
            writing.channel('/bare', None, 'cdr'),
        ]
        for number, channel in enumerate([*good, *others]):
            writing.add(channel, 1 + number * 1_000_000)
    return str(writing.path)


def test_the_other_topics_are_replayed(mixed, capsys):
    assert main([mixed, *QUICK]) == 0
    captured = capsys.readouterr()
    assert captured.out == '5 messages on 5 topics replayed\n'
    for text in (
        '/wheel: message type nowhere_msgs/msg/Wheel is not installed',
        '/json: its messages are json, not cdr',
        '/bare: ',
    ):
        assert f'replay: left out {text}' in captured.err


def test_a_topic_that_was_asked_for_is_not_left_out(mixed, capsys):
    assert main([mixed, *QUICK, '--topics', 'wheel', 'good_1']) == 2
    assert 'nowhere_msgs/msg/Wheel is not installed' in capsys.readouterr().err
    assert main([mixed, *QUICK, '--topics', 'good_1']) == 0


def test_a_bag_without_any_known_topic_is_refused(bag, capsys):
    with bag() as writing:
        writing.add(writing.channel('/wheel', STRANGE))
    assert main([str(writing.path), *QUICK]) == 2
    assert 'is not installed' in capsys.readouterr().err


def test_of_two_types_on_a_topic_one_is_replayed(bag, capsys):
    with bag() as writing:
        one, other = writing.channel(), writing.channel(schema=INT8)
        for number in range(6):
            if number % 3:
                writing.add(one, number)
            else:
                writing.add(other, number, b'\0\1\0\0\5')
    assert main([str(writing.path), *QUICK]) == 0
    captured = capsys.readouterr()
    assert 'left out /chatter: its messages of type std_msgs/msg/String' in captured.err
    assert captured.out == '2 messages on 1 topics replayed\n'


def test_a_message_that_is_not_of_its_type_is_one_line(bag, capsys):
    with bag() as writing:
        writing.add(writing.channel(schema=INT8), data=b'\0\1\0\0' + bytes(9))
    assert main([str(writing.path), *QUICK]) == 2
    assert 'a message on /chatter is not a std_msgs/msg/Int8' in capsys.readouterr().err


def test_a_type_that_was_defined_otherwise_is_named(bag, capsys):
    with bag() as writing:
        writing.add(writing.channel('/old', topic_type_hash=f'RIHS01_{"0" * 64}'))
        writing.add(writing.channel('/new'))
    assert main([str(writing.path), *QUICK]) == 0
    error = capsys.readouterr().err
    assert '/old: the installed std_msgs/msg/String differs from the recorded one' in error
    assert '/new:' not in error
