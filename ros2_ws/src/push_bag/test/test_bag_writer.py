"""A bag is finished, or stays readable up to where it was cut short."""

import resource
import tracemalloc

import pytest
from mcap.reader import make_reader
from push_bag.file.bag_writer import BagWriter
from push_bag.file.message_types import schema_text
from push_bag.file.reader import BagReader
from push_core.common.errors import InputError, RunError

STRING = 'std_msgs/msg/String'


def text(size):
    return b'\0\1\0\0' + (size + 1).to_bytes(4, 'little') + b'x' * size + b'\0'


@pytest.fixture
def small_disk():
    """Files of this process cannot grow beyond 20 kB."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, limits[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, limits)


def test_metadata_is_written_last(tmp_path):
    bag = BagWriter(tmp_path / 'run', {}, {})
    bag.add_topic('/text', STRING, '[]')
    assert not (tmp_path / 'run' / 'metadata.yaml').exists()
    bag.close()
    bag.close()
    assert sorted(path.name for path in (tmp_path / 'run').iterdir()) == [
        'metadata.yaml',
        'run_0.mcap',
    ]


def test_what_was_flushed_survives_a_kill(tmp_path):
    bag = BagWriter(tmp_path / 'run', {'seed': '1'}, {})
    bag.add_topic('/text', STRING, '[]')
    bag.write('/text', text(5), 10, 9, 1)
    bag.flush()
    bag.write('/text', text(5), 20, 19, 2)
    reader = BagReader(tmp_path / 'run')
    assert [record.sequence for record in reader.records()] == [1]
    assert reader.facts == {'seed': '1'}
    assert not reader.finished


def test_a_full_disk_stops_the_recording_and_leaves_it_readable(tmp_path, small_disk):
    bag = BagWriter(tmp_path / 'run', {}, {})
    bag.add_topic('/text', STRING, '[]')
    with pytest.raises(RunError, match='recording stopped, what was recorded stays readable'):
        for number in range(1, 10_000):
            bag.write('/text', text(50), number, number, number)
            bag.flush()
    assert not bag.is_open
    bag.close()
    read = [record.sequence for record in BagReader(tmp_path / 'run').records()]
    assert read == list(range(1, len(read) + 1))
    assert len(read) >= bag.counts['/text'] - 1 > 20
    assert not (tmp_path / 'run' / 'metadata.yaml').exists()


def test_memory_does_not_grow_with_the_recording_and_the_index_is_whole(tmp_path):
    chunks, topics = 2000, [f'/text_{number}' for number in range(10)]
    with BagWriter(tmp_path / 'run', {}, {}) as bag:
        for topic in topics:
            bag.add_topic(topic, STRING, '[]')
        tracemalloc.start()
        for number in range(1, chunks + 1):
            for topic in topics:
                bag.write(topic, text(5), number, number, number)
            bag.flush()
            if number == chunks // 10:
                before, _ = tracemalloc.get_traced_memory()
        after, _ = tracemalloc.get_traced_memory()
        tracemalloc.stop()
    assert after - before < 50 * chunks
    with bag.path.open('rb') as stream:
        summary = make_reader(stream).get_summary()
    assert [index.message_start_time for index in summary.chunk_indexes] == list(
        range(1, chunks + 1)
    )
    assert {len(index.message_index_offsets) for index in summary.chunk_indexes} == {len(topics)}


def test_an_existing_folder_is_refused(tmp_path):
    with pytest.raises(InputError, match='exists already'):
        BagWriter(tmp_path, {}, {})


def test_an_unknown_type_is_refused(tmp_path):
    with (
        BagWriter(tmp_path / 'run', {}, {}) as bag,
        pytest.raises(InputError, match='nowhere_msgs/msg/No is not installed'),
    ):
        bag.add_topic('/no', 'nowhere_msgs/msg/No', '[]')


def test_a_schema_names_each_dependency_once_after_its_line_of_80():
    sections = schema_text('geometry_msgs/msg/TwistStamped').split('\n' + '=' * 80 + '\n')
    assert [section.splitlines()[0] for section in sections[1:]] == [
        'MSG: std_msgs/Header',
        'MSG: geometry_msgs/Twist',
        'MSG: builtin_interfaces/Time',
        'MSG: geometry_msgs/Vector3',
    ]
