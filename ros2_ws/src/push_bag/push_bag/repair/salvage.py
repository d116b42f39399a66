"""Finds the intact records of a damaged MCAP file.

Chunks have checksums, so an intact chunk is recognised anywhere. After damaged bytes the search
continues at each byte that may begin a chunk. A record without a checksum is rejected if an intact
chunk begins within the length that it states. So every intact chunk is found.
"""

import mmap
import struct
import zlib
from collections.abc import Iterator
from typing import NamedTuple

from mcap.opcode import Opcode

from push_bag.file import MAGIC, DamagedError, RawRecord, chunk_data

_PREFIX = struct.Struct('<BQ')
_CHUNK_HEAD = struct.Struct('<QQQI')
_LENGTH = struct.Struct('<I')
_LONG_LENGTH = struct.Struct('<Q')
_COMPRESSIONS = (b'', b'zstd', b'lz4')
_FIRST_BYTE = bytes([Opcode.CHUNK])


class Damage(NamedTuple):
    """Bytes that belong to no intact record."""

    at: int
    length: int


class IntactChunk(NamedTuple):
    """The data of a chunk, decompressed: a sequence of records."""

    data: bytes


def parts_of(file: mmap.mmap) -> Iterator[IntactChunk | RawRecord | Damage]:
    """Intact chunks, other intact records and damaged ranges, in the order of the file."""
    at = len(MAGIC) if file[: len(MAGIC)] == MAGIC else 0
    end = len(file) - (len(MAGIC) if file[-len(MAGIC) :] == MAGIC else 0)
    while at < end:
        part, after = _part_at(file, at)
        if part is None:
            after = _next_chunk(file, at + 1, len(file))
        yield part or Damage(at, after - at)
        at = after


def _part_at(file: mmap.mmap, at: int) -> tuple[IntactChunk | RawRecord | None, int]:
    """The intact part at an offset, None without one, and the offset of its end."""
    after = _end_of_record(file, at)
    if after is None:
        return None, at
    opcode = file[at]
    if opcode == Opcode.CHUNK:
        chunk = _chunk_at(file, at)
        return (IntactChunk(chunk) if chunk is not None else None), after
    body = file[at + _PREFIX.size : after]
    if opcode == Opcode.ATTACHMENT:
        return (RawRecord(opcode, body) if _is_verified(body) else None), after
    chunk_within = _next_chunk(file, at + 1, after) < after
    return (None if chunk_within else RawRecord(opcode, body)), after


def _end_of_record(file: mmap.mmap, at: int) -> int | None:
    if at + _PREFIX.size > len(file):
        return None
    opcode, length = _PREFIX.unpack_from(file, at)
    after = at + _PREFIX.size + int(length)
    known = Opcode.HEADER <= opcode <= Opcode.DATA_END
    return after if known and after <= len(file) else None


def _next_chunk(file: mmap.mmap, begin: int, end: int) -> int:
    """Offset of the next intact chunk; `end` if none begins before it."""
    at = file.find(_FIRST_BYTE, begin, end)
    while at >= 0:
        if _chunk_at(file, at) is not None:
            return at
        at = file.find(_FIRST_BYTE, at + 1, end)
    return end


def _chunk_at(file: mmap.mmap, at: int) -> bytes | None:
    """The data of the intact chunk at an offset; None if there is none."""
    after = _end_of_record(file, at)
    if after is None or not _looks_like_chunk(file, at, after):
        return None
    try:
        return chunk_data(file[at + _PREFIX.size : after])
    except DamagedError:
        return None


def _looks_like_chunk(file: mmap.mmap, at: int, after: int) -> bool:
    """Whether the lengths in a chunk's header agree; cheap, because it is called often."""
    name_at = at + _PREFIX.size + _CHUNK_HEAD.size + _LENGTH.size
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
    """Whether an attachment's checksum is right or absent."""
    if len(attachment) < _LENGTH.size:
        return False
    (checksum,) = _LENGTH.unpack_from(attachment, len(attachment) - _LENGTH.size)
    return not checksum or zlib.crc32(attachment[: -_LENGTH.size]) == checksum
