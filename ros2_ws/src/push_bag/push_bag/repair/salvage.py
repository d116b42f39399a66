"""Finds what is whole in an MCAP file, however it ended and whatever was done to its bytes.

A chunk carries a checksum, so that a whole one is known wherever it stands. From a place where the
bytes make no sense the search goes on at each byte that could begin a chunk; and a record without
a checksum is not believed to be as long as it says if a whole chunk begins within it. So no whole
chunk is lost, whatever else is.
"""

import mmap
import struct
import zlib
from collections.abc import Iterator
from typing import NamedTuple

from mcap.opcode import Opcode

from push_bag.file import MAGIC, DamagedError, RawRecord, chunk_data

_OPENING = struct.Struct('<BQ')
_CHUNK_HEAD = struct.Struct('<QQQI')
_LENGTH = struct.Struct('<I')
_LONG_LENGTH = struct.Struct('<Q')
_COMPRESSIONS = (b'', b'zstd', b'lz4')
_FIRST_BYTE = bytes([Opcode.CHUNK])


class Damage(NamedTuple):
    """Bytes of the file that belong to nothing."""

    at: int
    length: int


class WholeChunk(NamedTuple):
    """The records of a chunk, decompressed."""

    data: bytes


def whole_parts(file: mmap.mmap) -> Iterator[WholeChunk | RawRecord | Damage]:
    """All that is whole in a file, and what is not, in the order of the file."""
    at = len(MAGIC) if file[: len(MAGIC)] == MAGIC else 0
    end = len(file) - (len(MAGIC) if file[-len(MAGIC) :] == MAGIC else 0)
    while at < end:
        found, after = _part_at(file, at)
        if found is None:
            after = _next_chunk(file, at + 1, len(file))
        yield found or Damage(at, after - at)
        at = after


def _part_at(file: mmap.mmap, at: int) -> tuple[WholeChunk | RawRecord | None, int]:
    """The part that begins at a byte, and the byte behind it; None where there is no whole one."""
    after = _end_of_record(file, at)
    if after is None:
        return None, at
    opcode = file[at]
    if opcode == Opcode.CHUNK:
        chunk = _chunk_at(file, at)
        return (WholeChunk(chunk) if chunk is not None else None), after
    body = file[at + _OPENING.size : after]
    if opcode == Opcode.ATTACHMENT:
        return (RawRecord(opcode, body) if _is_verified(body) else None), after
    chunk_within = _next_chunk(file, at + 1, after) < after
    return (None if chunk_within else RawRecord(opcode, body)), after


def _end_of_record(file: mmap.mmap, at: int) -> int | None:
    if at + _OPENING.size > len(file):
        return None
    opcode, length = _OPENING.unpack_from(file, at)
    after = at + _OPENING.size + int(length)
    known = Opcode.HEADER <= opcode <= Opcode.DATA_END
    return after if known and after <= len(file) else None


def _next_chunk(file: mmap.mmap, begin: int, end: int) -> int:
    """Where the next whole chunk begins, `end` where none begins before it."""
    at = file.find(_FIRST_BYTE, begin, end)
    while at >= 0:
        if _chunk_at(file, at) is not None:
            return at
        at = file.find(_FIRST_BYTE, at + 1, end)
    return end


def _chunk_at(file: mmap.mmap, at: int) -> bytes | None:
    """The data of a whole chunk that begins at a byte, None where none does."""
    after = _end_of_record(file, at)
    if after is None or not _looks_like_chunk(file, at, after):
        return None
    try:
        return chunk_data(file[at + _OPENING.size : after])
    except DamagedError:
        return None


def _looks_like_chunk(file: mmap.mmap, at: int, after: int) -> bool:
    """Whether the lengths in a chunk's head fit each other; cheap, for it is asked often."""
    name_at = at + _OPENING.size + _CHUNK_HEAD.size + _LENGTH.size
    if name_at > after:
        return False
    (name_length,) = _LENGTH.unpack_from(file, name_at - _LENGTH.size)
    data_at = name_at + int(name_length) + _LONG_LENGTH.size
    if name_length > 4 or data_at > after:
        return False
    if file[name_at : name_at + name_length] not in _COMPRESSIONS:
        return False
    (length,) = _LONG_LENGTH.unpack_from(file, data_at - _LONG_LENGTH.size)
    return data_at + int(length) == after


def _is_verified(attachment: bytes) -> bool:
    """Whether an attachment's checksum fits."""
    if len(attachment) < _LENGTH.size:
        return False
    (checksum,) = _LENGTH.unpack_from(attachment, len(attachment) - _LENGTH.size)
    return not checksum or zlib.crc32(attachment[: -_LENGTH.size]) == checksum
