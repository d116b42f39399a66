"""Reads the records of an MCAP file from front to back.

Used instead of the `mcap` library's readers because of damaged files: every size that the file
states is checked against what is there and against LARGEST_CHUNK before memory is allocated for
it. It is also twice as fast as the library's StreamReader (0.070 s against 0.134 s for 39,681
messages). Chunks are decompressed one at a time and their checksums verified.
"""

import struct
import zlib
from collections.abc import Iterator
from typing import IO, NamedTuple

import lz4.frame
import zstandard
from mcap.opcode import Opcode

MAGIC = b'\x89MCAP0\r\n'
LARGEST_CHUNK = 64 * 1024 * 1024  # [B] uncompressed; those of rosbag2 and of ours are far smaller
_OPENING = struct.Struct('<BQ')
_MESSAGE = struct.Struct('<HIQQ')
_CHUNK = struct.Struct('<QQQI')
_LENGTH = struct.Struct('<I')
_LONG_LENGTH = struct.Struct('<Q')
# what a reader from front to back has no use for
_INDICES = frozenset(
    (
        Opcode.MESSAGE_INDEX,
        Opcode.CHUNK_INDEX,
        Opcode.ATTACHMENT_INDEX,
        Opcode.METADATA_INDEX,
        Opcode.STATISTICS,
        Opcode.SUMMARY_OFFSET,
    )
)
_PRIVATE = 0x80  # opcodes from here on belong to whoever wrote the file


class CutShortError(Exception):
    """The file ends within a record."""


class DamagedError(Exception):
    """The bytes are not those that were written; the message says what is wrong."""


class RawRecord(NamedTuple):
    """A record: what it is, and its bytes without their opening."""

    opcode: int
    body: bytes


class RawMessage(NamedTuple):
    """A message of a chunk; times in ns."""

    channel: int
    sequence: int
    log_ns: int
    publish_ns: int
    data: bytes


def top_records(stream: IO[bytes], size: int) -> Iterator[RawRecord]:
    """The records of a file up to its footer, indices left out.

    Args:
        stream: at the file's beginning.
        size: of the file [B].

    Raises:
        CutShortError: the file ends within a record.
        DamagedError: it does not begin as MCAP does, or has a record of no known kind.
    """
    magic = stream.read(len(MAGIC))
    if magic != MAGIC[: len(magic)]:
        raise DamagedError('it does not begin as an MCAP file does')
    while True:
        record = _next_record(stream, size)
        if record is None:
            continue
        yield record
        if record.opcode == Opcode.FOOTER:
            return


def _next_record(stream: IO[bytes], size: int) -> RawRecord | None:
    """The next record, None for one that nobody needs."""
    opening = stream.read(_OPENING.size)
    if len(opening) < _OPENING.size:
        raise CutShortError
    opcode, length = _OPENING.unpack(opening)
    if not Opcode.HEADER <= opcode <= Opcode.DATA_END and opcode < _PRIVATE:
        raise DamagedError(f'no record begins with byte {opcode}')
    if stream.tell() + length > size:
        raise CutShortError
    if opcode in _INDICES or opcode >= _PRIVATE:
        stream.seek(length, 1)
        return None
    return RawRecord(opcode, stream.read(length))


def chunk_data(body: bytes) -> bytes:
    """The records of a chunk, decompressed and verified.

    Raises:
        DamagedError: they cannot be had from these bytes.
    """
    try:
        _, _, size, checksum = _CHUNK.unpack_from(body)
        (name_length,) = _LENGTH.unpack_from(body, _CHUNK.size)
        begin = _CHUNK.size + _LENGTH.size + name_length
        name = body[_CHUNK.size + _LENGTH.size : begin]
        (length,) = _LONG_LENGTH.unpack_from(body, begin)
    except struct.error:
        raise DamagedError('a chunk is too short') from None
    begin += _LONG_LENGTH.size
    if size > LARGEST_CHUNK or begin + length > len(body):
        raise DamagedError('a chunk claims more than there is')
    data = _decompressed(name, body[begin : begin + length], size)
    if len(data) != size or (checksum and zlib.crc32(data) != checksum):
        raise DamagedError('the checksum of a chunk does not fit')
    return data


def _decompressed(name: bytes, data: bytes, size: int) -> bytes:
    try:
        if name == b'zstd':
            # a frame that states a size is given all of it, whatever the limit
            if zstandard.frame_content_size(data) > size:
                raise DamagedError('a chunk is larger than it says')
            return zstandard.ZstdDecompressor().decompress(data, max_output_size=size)
        if name == b'lz4':
            return bytes(lz4.frame.LZ4FrameDecompressor().decompress(data, max_length=size))
    except (zstandard.ZstdError, RuntimeError, ValueError, EOFError) as error:
        raise DamagedError(f'a chunk does not decompress: {error}') from None
    if name:
        raise DamagedError('a chunk is compressed in an unknown way')
    return data


def chunk_records(data: bytes) -> Iterator[RawMessage | RawRecord]:
    """Messages, schemas and channels of a chunk's data.

    Raises:
        DamagedError: a record goes on beyond the end.
    """
    at, end = 0, len(data)
    while at < end:
        if end - at < _OPENING.size:
            raise DamagedError('a chunk ends within a record')
        opcode, length = _OPENING.unpack_from(data, at)
        at += _OPENING.size
        if length > end - at:
            raise DamagedError('a record is longer than its chunk')
        body = data[at : at + length]
        yield message(body) if opcode == Opcode.MESSAGE else RawRecord(opcode, body)
        at += length


def message(body: bytes) -> RawMessage:
    """A message from the bytes of its record.

    Raises:
        DamagedError: they are fewer than a message can have.
    """
    if len(body) < _MESSAGE.size:
        raise DamagedError('a message is too short')
    channel, sequence, log_ns, publish_ns = _MESSAGE.unpack_from(body)
    return RawMessage(channel, sequence, log_ns, publish_ns, body[_MESSAGE.size :])
