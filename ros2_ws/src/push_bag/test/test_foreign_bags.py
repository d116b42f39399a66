"""Bags of other programs: what recover saves is as it was, whatever wrote it."""

import io
import tracemalloc

import pytest
from mcap.reader import make_reader
from mcap.stream_reader import StreamReader
from mcap.writer import CompressionType
from push_bag.commands.info import main as info
from push_bag.file.reader import BagReader
from push_bag.repair.recover import main, recover

TEXT = b'\0\1\0\0\2\0\0\0a\0'
MB = 1_000_000
OWN = ('run', 'recovery')  # metadata records that recover adds


def saved(path):
    """The recovered file of a bag."""
    folder = path.with_name('saved')
    recover(path, folder)
    return folder / 'saved_0.mcap'


def described(path):
    """Channels with their schemas, metadata and attachments of a file, each sorted."""
    with path.open('rb') as stream:
        reader = make_reader(stream)
        summary = reader.get_summary()
        schemas = {
            number: (each.name, each.encoding, each.data)
            for number, each in summary.schemas.items()
        }
        channels = sorted(
            (
                each.topic,
                each.message_encoding,
                schemas.get(each.schema_id),
                sorted(each.metadata.items()),
            )
            for each in summary.channels.values()
        )
        metadata = [
            (each.name, each.metadata) for each in reader.iter_metadata() if each.name not in OWN
        ]
        attached = [
            (each.name, each.media_type, each.log_time, each.create_time, each.data)
            for each in reader.iter_attachments()
        ]
    return channels, metadata, attached


def messages(path):
    with path.open('rb') as stream:
        return [
            (channel.topic, each.log_time, each.publish_time, each.sequence, each.data)
            for _, channel, each in make_reader(stream).iter_messages(log_time_order=False)
        ]


@pytest.mark.parametrize(
    ('schema', 'encoding', 'data'),
    [
        (('demo/msg/P', 'ros2idl', b'module demo {};'), 'cdr', TEXT),
        (('demo.P', 'jsonschema', b'{"type":"object"}'), 'json', b'{"x":1}'),
        (('demo.P', 'protobuf', bytes(range(256))), 'protobuf', b'\x08\x01'),
        (('demo', 'flatbuffer', b'\xff\xfe'), 'flatbuffer', b'\0'),
        (('std_msgs/String', 'ros1msg', b'string data\n'), 'ros1', b'\1\0\0\0a'),
        (('plc', '', b''), '', b'free text'),
        (None, 'text', b'free text'),
        (('std_msgs/msg/Empty', 'ros2msg', b''), 'cdr', b'\0\1\0\0\0'),
    ],
    ids=['idl', 'json', 'protobuf', 'flatbuffer', 'ros1', 'no encoding', 'no schema', 'empty'],
)
def test_schema_and_encoding_are_kept(bag, schema, encoding, data):
    with bag() as writing:
        writing.add(writing.channel('/p', schema, encoding, origin='plc'), data=data)
    out = saved(writing.path)
    assert described(out) == described(writing.path)
    assert messages(out) == messages(writing.path) == [('/p', 10, 9, 0, data)]


def test_metadata_and_attachments_are_kept(bag):
    with bag(profile='ros1') as writing:
        channel = writing.channel(calibration='v3', offered_qos_profiles='not yaml: [')
        writing.writer.add_metadata('operator', {'who': 'me'})
        writing.writer.add_metadata('operator', {'who': 'you'})
        writing.writer.add_metadata('recording', {'camera': 'off', '/chatter': '{}'})
        writing.writer.add_attachment(7, 5, 'photo.png', 'image/png', b'\x89PNG')
        writing.add(channel)
        writing.writer.add_attachment(8, 6, 'photo.png', 'image/jpeg', b'\xff\xd8')
        writing.writer.add_attachment(0, 0, 'ä/b', '', b'')
    out = saved(writing.path)
    assert described(out) == described(writing.path)
    with out.open('rb') as stream:
        reader = make_reader(stream, validate_crcs=True)
        assert reader.get_header().profile == 'ros1'
        assert reader.get_summary().statistics.attachment_count == 3


def test_facts_of_the_run_are_kept_and_the_origin_added(bag):
    with bag() as writing:
        writing.writer.add_metadata('run', {'seed': '7', 'recovered_from': 'older.mcap'})
        writing.add(writing.channel())
    out = saved(writing.path)
    reader = BagReader(out)
    list(reader.records())
    assert reader.facts['seed'] == '7'
    assert reader.facts['recovered_from'] == 'other.mcap'
    with out.open('rb') as stream:
        runs = [each.metadata for each in make_reader(stream).iter_metadata()]
    assert {'seed': '7', 'recovered_from': 'older.mcap'} in runs


def test_two_types_and_two_publishers_of_one_topic_are_kept(bag, capsys):
    with bag() as writing:
        other = ('std_msgs/msg/Int8', 'ros2msg', b'int8 data\n')
        channels = [writing.channel(), writing.channel(schema=other), writing.channel()]
        for number in range(9):
            writing.add(channels[number % 3], 10 + number, sequence=1 + number // 3)
    out = saved(writing.path)
    assert described(out) == described(writing.path)
    assert messages(out) == messages(writing.path)
    assert len(described(out)[0]) == 3
    assert info([str(out)]) == 0
    rows = [line.split()[1:4] for line in capsys.readouterr().out.splitlines() if '/chat' in line]
    assert rows[:2] == [['std_msgs/msg/Int8', '3', '0'], ['std_msgs/msg/String', '6', '0']]


def test_a_channel_without_messages_is_kept(bag):
    with bag() as writing:
        writing.channel('/quiet')
        writing.add(writing.channel('/loud'))
    assert described(saved(writing.path)) == described(writing.path)


@pytest.mark.parametrize('compression', list(CompressionType))
@pytest.mark.parametrize('size', [10_000, 5_000_000], ids=['many messages', 'large messages'])
def test_a_chunk_of_any_size_is_read_with_little_memory(bag, compression, size):
    """One chunk of 40 MB, and an attachment of 40 MB."""
    count = 40 * MB // size
    with bag(compression=compression, chunk_size=100 * MB) as writing:
        channel = writing.channel()
        for number in range(1, count + 1):
            writing.add(channel, number, TEXT + bytes(size), number)
        writing.writer.add_attachment(1, 2, 'model', 'text/plain', bytes(40 * MB))
    tracemalloc.start()
    found = recover(writing.path, writing.path.with_name('saved'))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert (found.messages, found.missing, found.damaged_bytes) == (count, 0, 0)
    # the writer holds a message several times while it compresses it
    assert peak < 25 * MB + 6 * size
    reader = BagReader(writing.path)
    assert sum(len(each.data) for each in reader.records()) == count * (size + len(TEXT))
    assert BagReader(writing.path.with_name('saved')).paths[0].stat().st_size > 40 * MB


def test_damage_in_a_large_chunk_costs_that_chunk_alone(bag):
    with bag(compression=CompressionType.NONE, chunk_size=6 * MB) as writing:
        channel = writing.channel()
        for number in range(1, 13_001):
            writing.add(channel, number * 1_000_000, TEXT + bytes(1_000), number)
    content = bytearray(writing.path.read_bytes())
    content[3 * MB] ^= 1
    writing.path.write_bytes(content)
    found = recover(writing.path, writing.path.with_name('saved'))
    assert found.messages + found.missing == 13_000
    assert 5_000 < found.missing < 7_000


def test_a_damaged_chunk_without_a_checksum_is_not_called_whole(bag):
    with bag(compression=CompressionType.NONE, enable_crcs=False) as writing:
        channel = writing.channel()
        for number in range(1, 101):
            writing.add(channel, number, TEXT, number)
    content = writing.path.read_bytes()
    at = content.index(TEXT, content.index(TEXT) + 500)
    # the length of a message within the chunk
    spoilt = content[: at - 30] + b'\xff' * 8 + content[at - 22 :]
    writing.path.write_bytes(spoilt)
    found = recover(writing.path, writing.path.with_name('saved'))
    assert 0 < found.messages < 100
    assert found.missing == 100 - found.messages
    assert found.damaged_bytes > 0


def test_private_records_are_counted(bag, capsys):
    with bag() as writing:
        writing.add(writing.channel())
        writing.writer.flush()
        writing.stream.write(b'\x90' + (5).to_bytes(8, 'little') + b'hello')
    assert main([str(writing.path), '-o', str(writing.path.with_name('out'))]) == 0
    assert '1 records not saved: private to another program' in capsys.readouterr().out


def test_messages_whose_channel_is_damaged_are_counted(bag):
    with bag(use_chunking=False, repeat_channels=False) as writing:
        one, other = writing.channel('/one'), writing.channel('/two')
        for number in range(10):
            writing.add(other if number % 2 else one, number, sequence=number + 1)
    content = writing.path.read_bytes()
    # the channel's record becomes one of an unknown private kind
    at = content.index(b'/two') - 8 - 9
    writing.path.write_bytes(content[:at] + b'\x90' + content[at + 1 :])
    found = recover(writing.path, writing.path.with_name('saved'))
    assert (found.messages, found.unknown) == (5, 5)
    assert '5 messages not saved: their channel is missing' in found.text()


@pytest.mark.parametrize('with_statistics', [True, False])
def test_what_is_missing_of_unnumbered_messages_is_said_to_be_unknown(bag, with_statistics):
    with bag(chunk_size=100, use_statistics=with_statistics) as writing:
        channel = writing.channel()
        for number in range(1, 41):
            writing.add(channel, number * 10_000_000)
    content = bytearray(writing.path.read_bytes())
    content[content.index(b'(\xb5/\xfd') + 20] ^= 255
    writing.path.write_bytes(content)
    found = recover(writing.path, writing.path.with_name('saved'))
    assert found.damaged_bytes > 0
    assert found.missing == (40 - found.messages if with_statistics else None)
    assert ('is not known' in found.text()) is not with_statistics


def test_a_sound_file_without_statistics_misses_nothing(bag):
    with bag(use_statistics=False) as writing:
        writing.add(writing.channel())
    assert recover(writing.path, writing.path.with_name('saved')).missing == 0


def test_the_copy_is_read_by_the_stream_reader_of_the_format(bag):
    with bag() as writing:
        writing.writer.add_attachment(1, 2, 'a', 'text/plain', b'x' * 3_000_000)
        writing.add(writing.channel())
    content = saved(writing.path).read_bytes()
    kinds = [type(each).__name__ for each in StreamReader(io.BytesIO(content)).records]
    assert kinds.count('Attachment') == 1
    assert kinds[-1] == 'Footer'
