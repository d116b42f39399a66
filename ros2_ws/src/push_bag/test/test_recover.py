"""All intact chunks of a damaged bag are recovered, and missing messages are counted."""

import random

import pytest
from push_bag.file.reader import BagReader
from push_bag.repair import recover as command
from push_bag.repair.recover import recover
from push_bag.stream import ByteFile, chunk, chunk_records, spans
from push_core.common.errors import InputError


@pytest.fixture(scope='module')
def content(perfect):
    return BagReader(perfect).path.read_bytes()


@pytest.fixture(scope='module')
def chunks(perfect):
    """Offsets of start and end of each chunk, and its number of messages."""
    found = []
    with ByteFile(BagReader(perfect).path) as file:
        for span in spans(file):
            if span.opcode == 6:
                records = chunk_records(chunk(file, span))
                count = sum(1 for each in records if len(each) == 5)
                found.append((span.begin - 9, span.end, count))
    return found


@pytest.fixture
def broken(tmp_path):
    def write(data):
        path = tmp_path / 'broken.mcap'
        path.write_bytes(data)
        return path

    return write


def messages(path):
    return [(each.topic, *each[1:]) for each in BagReader(path).records()]


def test_a_sound_bag_is_recovered_message_by_message(perfect, tmp_path):
    found = recover(perfect, tmp_path / 'out')
    assert messages(tmp_path / 'out') == messages(perfect)
    ours, theirs = BagReader(perfect), BagReader(tmp_path / 'out')
    list(ours.records()), list(theirs.records())
    assert theirs.facts.items() >= ours.facts.items()
    assert theirs.facts['recovered_from'] == 'perfect_0.mcap'
    assert theirs.attachments == ours.attachments
    assert theirs.finished
    assert (found.missing, found.missing_ns, found.damaged_bytes) == (0, 0, 0)


def test_a_cut_bag_keeps_every_chunk_before_the_cut(chunks, content, broken, tmp_path):
    for number, end in enumerate(chance_cuts(len(content))):
        whole = sum(count for _, last, count in chunks if last <= end)
        if not whole:
            continue
        recover(broken(content[:end]), tmp_path / str(number))
        assert len(messages(tmp_path / str(number))) == whole


def chance_cuts(size):
    chance = random.Random(0)
    return [chance.randrange(1000, size) for _ in range(8)]


def test_damage_loses_the_chunks_that_it_touches_and_no_other(chunks, content, broken, tmp_path):
    chance = random.Random(1)
    for number in range(8):
        at, length = chance.randrange(8, len(content)), chance.randrange(1, 2000)
        spoilt = content[:at] + chance.randbytes(length) + content[at + length :]
        path = broken(spoilt[: len(content)])
        whole = sum(n for first, last, n in chunks if last <= at or first >= at + length)
        recover(path, tmp_path / str(number))
        assert len(messages(tmp_path / str(number))) == whole


def test_bytes_that_were_taken_out_shift_the_rest_and_lose_no_more(
    chunks, content, broken, tmp_path
):
    first, last, count = chunks[1]
    found = recover(broken(content[: first + 5] + content[last - 7 :]), tmp_path / 'out')
    assert found.messages == sum(each for _, _, each in chunks) - count
    assert found.missing == count
    assert 0.2e9 < found.missing_ns < 0.3e9


def test_without_the_end_missing_messages_are_counted_by_their_numbers(
    chunks, content, broken, tmp_path
):
    first, last, count = chunks[1]
    end = chunks[3][1]
    found = recover(broken(content[:first] + content[last:end]), tmp_path / 'out')
    assert found.missing == count
    assert 'cut short' in found.text()


def test_a_file_without_a_chunk_gives_one_line_and_makes_no_folder(broken, tmp_path, capsys):
    for data in (b'', b'no bag at all' * 50):
        assert command.main([str(broken(data)), '-o', str(tmp_path / 'out')]) == 2
        assert capsys.readouterr().err.count('\n') == 1
        assert not (tmp_path / 'out').exists()


def test_an_existing_folder_is_not_touched(perfect, tmp_path):
    with pytest.raises(InputError, match='exists already'):
        recover(perfect, tmp_path)


def test_a_full_disk_leaves_nothing_half_written(perfect, tmp_path, monkeypatch, capsys):
    def full(*_):
        raise OSError(28, 'No space left on device')

    monkeypatch.setattr('mcap.writer.Writer.finish', full)
    assert command.main([str(perfect), '-o', str(tmp_path / 'out')]) == 1
    assert capsys.readouterr().err.endswith('out: No space left on device\n')
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_was_there_is_kept(perfect, tmp_path, capsys):
    kept = tmp_path / 'notes.txt'
    kept.write_text('mine')
    assert command.main([str(perfect), '-o', str(tmp_path)]) == 2
    assert 'exists already' in capsys.readouterr().err
    assert kept.read_text() == 'mine'
