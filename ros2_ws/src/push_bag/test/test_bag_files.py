"""Split bags are read as one; what is no MCAP file is named."""

import bz2
import gzip
import lzma
import os
import sqlite3
import threading

import lz4.frame
import pytest
import yaml
import zstandard
from push_bag.commands.export import main as export
from push_bag.commands.info import main as info
from push_bag.commands.replay import main as replay
from push_bag.commands.score import main as score
from push_bag.file.bag_files import bag_files
from push_bag.file.bag_writer import BagWriter
from push_bag.file.reader import BagReader
from push_bag.repair.recover import main as recover_main
from push_bag.repair.recover import recover
from push_bag.score.score import score_run
from push_core.common.errors import InputError

COMMANDS = [info, score]


def listing(folder, names):
    """Writes `metadata.yaml` with a list of files."""
    information = {'version': 9, 'storage_identifier': 'mcap', 'relative_file_paths': names}
    text = yaml.safe_dump({'rosbag2_bagfile_information': information})
    (folder / 'metadata.yaml').write_text(text)


@pytest.fixture
def split(perfect, tmp_path):
    """The perfect run, split into three files as by rosbag2; their names are not in order."""
    folder = tmp_path / 'split'
    folder.mkdir()
    reader = BagReader(perfect)
    records = list(reader.records())
    third = len(records) // 3
    names = ['split_2.mcap', 'split_10.mcap', 'split_9.mcap']
    for number, name in enumerate(names):
        part = records[number * third : (number + 1) * third if number < 2 else None]
        with BagWriter(tmp_path / str(number), reader.facts, {}) as writer:
            for each in reader.topics.values():
                writer.add_topic(each.name, each.type_name, each.qos)
            for each in part:
                writer.write(each.topic.name, *each[1:])
        (tmp_path / str(number) / f'{number}_0.mcap').rename(folder / name)
    listing(folder, names)
    return folder


def test_a_split_bag_is_read_in_the_order_of_its_metadata(perfect, split):
    reader = BagReader(split)
    assert [path.stem for path in reader.paths] == ['split_2', 'split_10', 'split_9']
    one, several = list(BagReader(perfect).records()), list(reader.records())
    assert [each[1:] for each in several] == [each[1:] for each in one]
    assert reader.finished
    assert reader.facts['seed'] == '7'


def test_a_split_bag_scores_as_the_whole_one(perfect, split):
    whole, parts = score_run(perfect), score_run(split)
    assert parts == whole


def test_info_export_and_replay_read_a_split_bag(split, tmp_path, capsys):
    assert info([str(split)]) == 0
    out = capsys.readouterr().out
    assert '3 files: split_2.mcap, split_10.mcap, split_9.mcap' in out
    assert '0 of ' in out
    assert export([str(split), '--csv', '-o', str(tmp_path / 'run.csv')]) == 0
    assert capsys.readouterr().out.startswith('191 rows')


def test_recover_makes_one_file_of_a_split_bag(perfect, split, tmp_path):
    found = recover(split, tmp_path / 'out')
    assert (found.missing, found.missing_ns, found.damaged_bytes) == (0, 0, 0)
    reader = BagReader(tmp_path / 'out')
    one = [(each.topic.name, *each[1:]) for each in BagReader(perfect).records()]
    assert [(each.topic.name, *each[1:]) for each in reader.records()] == one
    names = [each.name for each in reader.all_topics]
    assert len(names) == len(set(names))
    assert reader.facts['recovered_from'] == 'split_2.mcap, split_10.mcap, split_9.mcap'


def test_damage_in_one_part_is_counted(split, tmp_path):
    path = split / 'split_10.mcap'
    content = bytearray(path.read_bytes())
    content[content.index(b'\x28\xb5\x2f\xfd') + 50] ^= 1
    path.write_bytes(content)
    found = recover(split, tmp_path / 'out')
    assert found.missing > 0
    assert found.damaged_bytes > 0


def test_parts_without_metadata_are_in_the_order_of_their_numbers(split):
    (split / 'metadata.yaml').unlink()
    names = [path.name for path in bag_files(split)]
    assert names == ['split_2.mcap', 'split_9.mcap', 'split_10.mcap']


def test_unrelated_files_in_a_folder_are_not_read_as_one(split):
    (split / 'metadata.yaml').unlink()
    (split / 'other.mcap').write_bytes(b'')
    with pytest.raises(InputError, match='holds 4 MCAP files; name the one to read'):
        bag_files(split)


def test_a_part_that_is_missing_is_named(split):
    (split / 'split_9.mcap').unlink()
    with pytest.raises(InputError, match=r'split_9.mcap is missing, which metadata.yaml lists'):
        bag_files(split)


def test_the_first_versions_of_rosbag2_list_the_folder_too(split):
    listing(split, ['split/split_9.mcap', 'split/split_2.mcap'])
    assert [path.name for path in bag_files(split)] == ['split_9.mcap', 'split_2.mcap']


def test_a_renamed_file_of_a_folder_is_read(perfect, tmp_path):
    folder = tmp_path / 'renamed'
    folder.mkdir()
    (folder / 'mine.mcap').write_bytes(BagReader(perfect).path.read_bytes())
    for text in ('not: [yaml', 'rosbag2_bagfile_information: {relative_file_paths: [a.mcap]}'):
        (folder / 'metadata.yaml').write_text(text)
        assert [path.name for path in bag_files(folder)] == ['mine.mcap']


PACKERS = {
    'zstd': (zstandard.compress, 'zstd -d {0}.mcap.zstd -o {0}.mcap'),
    'lz4': (lz4.frame.compress, 'lz4 -d {0}.mcap.lz4 {0}.mcap'),
    'gz': (gzip.compress, 'gunzip -c {0}.mcap.gz > {0}.mcap'),
    'bz2': (bz2.compress, 'bunzip2 -c {0}.mcap.bz2 > {0}.mcap'),
    'xz': (lzma.compress, 'unxz -c {0}.mcap.xz > {0}.mcap'),
}


@pytest.mark.parametrize('main', COMMANDS)
@pytest.mark.parametrize('kind', PACKERS)
def test_a_compressed_file_is_named_with_the_command_that_unpacks_it(
    perfect, tmp_path, capsys, main, kind
):
    pack, command = PACKERS[kind]
    path = tmp_path / f'run.mcap.{kind}'
    path.write_bytes(pack(BagReader(perfect).path.read_bytes()))
    assert main([str(path)]) == 2
    error = capsys.readouterr().err
    assert f'is compressed; unpack it with `{command.format(tmp_path / "run")}`' in error
    assert error.count('\n') == 1


def test_a_compressed_split_bag_is_read_once_it_is_unpacked(split, perfect):
    names = ['split_2.mcap', 'split_10.mcap', 'split_9.mcap']
    listing(split, [f'{name}.zstd' for name in names])
    contents = {name: (split / name).read_bytes() for name in names}
    for name in names:
        (split / f'{name}.zstd').write_bytes(zstandard.compress(contents[name]))
        (split / name).unlink()
    with pytest.raises(InputError, match=r'split_2\.mcap\.zstd is compressed; unpack it with'):
        bag_files(split)
    for name in names:
        (split / name).write_bytes(contents[name])
    assert score_run(split) == score_run(perfect)


def test_a_compressed_file_of_another_name_is_known_by_its_bytes(perfect, tmp_path):
    path = tmp_path / 'run.mcap'
    path.write_bytes(zstandard.compress(BagReader(perfect).path.read_bytes()))
    with pytest.raises(InputError, match=r'zstd -d \S+run.mcap -o \S+run.unpacked.mcap'):
        bag_files(path)


def test_bags_of_other_formats_are_named(tmp_path):
    path = tmp_path / 'bag_0.db3'
    connection = sqlite3.connect(path)
    connection.execute('create table messages (id integer)')
    connection.commit()
    connection.close()
    for each in (path, tmp_path):
        with pytest.raises(InputError, match='is a bag in SQLite; `ros2 bag convert`'):
            bag_files(each)
    (tmp_path / 'old.bag').write_bytes(b'#ROSBAG V2.0\n')
    with pytest.raises(InputError, match='is a bag of ROS 1'):
        bag_files(tmp_path / 'old.bag')


@pytest.mark.parametrize('main', [*COMMANDS, replay])
def test_a_pipe_is_named(tmp_path, capsys, main):
    path = tmp_path / 'pipe'
    os.mkfifo(path)
    opened = threading.Thread(target=lambda: path.open('wb').close(), daemon=True)
    opened.start()
    assert main([str(path)]) == 2
    error = capsys.readouterr().err
    assert 'is a pipe' in error
    assert 'does not exist' not in error
    path.open('rb').close()
    opened.join()


def test_recover_names_them_too(tmp_path, capsys):
    path = tmp_path / 'run.mcap.zstd'
    path.write_bytes(zstandard.compress(b'x' * 100))
    assert recover_main([str(path), '-o', str(tmp_path / 'out')]) == 2
    assert 'is compressed' in capsys.readouterr().err
    assert not (tmp_path / 'out').exists()


def test_messages_that_are_compressed_one_by_one_are_named(perfect, tmp_path, capsys):
    reader = BagReader(perfect)
    with BagWriter(tmp_path / 'run', {}, {}) as writer:
        for each in reader.records():
            if each.topic.name not in writer.counts:
                writer.add_topic(each.topic.name, each.topic.type_name, each.topic.qos)
            writer.write(each.topic.name, zstandard.compress(each.data), *each[2:])
    for main in (score, replay):
        assert main([str(tmp_path / 'run')]) == 2
        error = capsys.readouterr().err
        assert 'compressed one by one' in error
        assert error.count('\n') == 1


@pytest.mark.parametrize('length', [0, 30])
def test_an_empty_last_part_of_a_killed_recording_is_not_in_the_way(split, capsys, length):
    (split / 'metadata.yaml').unlink()
    content = (split / 'split_2.mcap').read_bytes()
    (split / 'split_11.mcap').write_bytes(content[:length])
    assert info([str(split)]) == 0
    assert 'unfinished' in capsys.readouterr().out
