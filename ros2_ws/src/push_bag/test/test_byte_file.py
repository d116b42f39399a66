"""A file is searched and read through a window as if it were in memory."""

import random

import pytest
from push_bag.stream import byte_file
from push_bag.stream.byte_file import ByteFile


@pytest.fixture
def content(tmp_path, monkeypatch):
    """A file of 1000 bytes with few values, and a window of 64 bytes."""
    monkeypatch.setattr(byte_file, 'WINDOW', 64)
    chance = random.Random(0)
    data = bytes(chance.randrange(40) for _ in range(1000))
    path = tmp_path / 'file'
    path.write_bytes(data)
    return path, data


def test_any_piece_is_read(content):
    path, data = content
    chance = random.Random(1)
    with ByteFile(path) as file:
        for _ in range(500):
            at, count = chance.randrange(1010), chance.randrange(200)
            assert file.read(at, count) == data[at : at + count]


def test_bytes_are_found_in_any_range(content):
    path, data = content
    chance = random.Random(2)
    with ByteFile(path) as file:
        for _ in range(500):
            begin, end = chance.randrange(1010), chance.randrange(1010)
            wanted = bytes([chance.randrange(45)])
            assert file.find(wanted, begin, end) == data.find(wanted, begin, end)


def test_a_search_reads_each_window_once(content, monkeypatch):
    path, data = content
    loaded = []
    with ByteFile(path) as file:
        from_disk = file._from_disk
        monkeypatch.setattr(
            file, '_from_disk', lambda at, count: loaded.append(at) or from_disk(at, count)
        )
        found, at = [], file.find(b'\x06', 0, 1000)
        while at >= 0:
            found.append(at)
            at = file.find(b'\x06', at + 1, 1000)
    assert found == [place for place, byte in enumerate(data) if byte == 6]
    assert len(loaded) == 1000 // 64 + 1


def test_blocks_are_the_whole(content):
    path, data = content
    with ByteFile(path) as file:
        assert b''.join(file.blocks(10, 990)) == data[10:990]
