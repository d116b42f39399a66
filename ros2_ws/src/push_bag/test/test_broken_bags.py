"""Missing and damaged bags give a one-line error, or the readable part."""

import contextlib
import random

import pytest
from fuzz_bag import DAMAGES, READERS
from push_bag.commands import info
from push_bag.commands import score as score_command
from push_bag.file.reader import BagReader
from push_core.common.errors import InputError


@pytest.fixture
def content(perfect):
    return BagReader(perfect).path.read_bytes()


@pytest.mark.parametrize('main', [info.main, score_command.main], ids=['info', 'score'])
@pytest.mark.parametrize(
    ('spoil', 'reason'),
    [
        (lambda _: b'', 'ends before its first message'),
        (lambda whole: whole[:20], 'ends before its first message'),
        (lambda _: b'time,x,y\n0,1,2\n' * 100, 'is no bag or is damaged'),
        (lambda whole: whole[:30_000] + b'\0' * 5_000 + whole[35_000:], 'damaged'),
    ],
    ids=['empty', 'a header only', 'text', 'overwritten'],
)
def test_a_file_that_is_not_a_bag_gives_one_line_and_status_2(
    tmp_path, content, capsys, main, spoil, reason
):
    path = tmp_path / 'bad.mcap'
    path.write_bytes(spoil(content))
    assert main([str(path)]) == 2
    captured = capsys.readouterr()
    assert captured.out == ''
    assert captured.err.count('\n') == 1
    assert reason in captured.err


def test_a_missing_bag_and_an_empty_folder_give_one_line(tmp_path, capsys):
    assert info.main([str(tmp_path / 'none')]) == 2
    assert 'does not exist' in capsys.readouterr().err
    assert info.main([str(tmp_path)]) == 2
    assert 'holds no MCAP file' in capsys.readouterr().err


def test_a_bag_without_its_end_is_read_as_far_as_it_goes(tmp_path, content, capsys):
    path = tmp_path / 'cut.mcap'
    path.write_bytes(content[: len(content) // 2])
    assert info.main([str(path)]) == 0
    assert 'unfinished' in capsys.readouterr().out
    assert score_command.main([str(path)]) == 0
    assert capsys.readouterr().out.splitlines()[0].split() == ['completed', 'no']


def test_an_attachment_of_impossible_length_is_damage(content, tmp_path):
    at = content.index(b'params.yaml')
    begin = content.index(b'application/octet-stream', at) + len(b'application/octet-stream')
    path = tmp_path / 'long.mcap'
    path.write_bytes(content[:begin] + b'\xff' * 8 + content[begin + 8 :])
    with pytest.raises(InputError, match='a record is not readable'):
        list(BagReader(path).records())


@pytest.mark.parametrize('spoil', DAMAGES)
@pytest.mark.parametrize('name', READERS)
def test_damage_of_any_kind_gives_messages_or_an_input_error(tmp_path, content, spoil, name):
    """tests/tools/random_input/fuzz_bag.py does the same with more cases."""
    chance = random.Random(0)
    for number in range(10):
        path = tmp_path / f'damaged_{number}.mcap'
        path.write_bytes(spoil(bytearray(content), chance))
        with contextlib.suppress(InputError):
            READERS[name](path)
