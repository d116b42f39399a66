"""The records of an MCAP file from front to back.

Used instead of the `mcap` library's readers because of damaged files: every size that the file
states is checked against what is there before memory is allocated for it.
"""

import struct
from collections.abc import Iterator
from typing import NamedTuple

from mcap.opcode import Opcode

from push_bag.stream.byte_file import ByteFile

MAGIC = b'\x89MCAP0\r\n'
_PREFIX = struct.Struct('<BQ')
_MESSAGE = struct.Struct('<HIQQ')
_PRIVATE = 0x80  # opcodes from here on are private to the program that wrote the file


class CutShortError(Exception):
    """The file ends within a record."""


class DamagedError(Exception):
    """The file is damaged; the message says where."""


class Span(NamedTuple):
    """A record's opcode, and the offsets of the begin and end of its body."""

    opcode: int
    begin: int
    end: int

    @property
    def is_private(self) -> bool:
        """Whether the record is private to the program that wrote the file."""
        return self.opcode >= _PRIVATE


class RawRecord(NamedTuple):
    """A record: its opcode, and its bytes after opcode and length."""

    opcode: int
    body: bytes


class RawMessage(NamedTuple):
    """A message record; times in ns."""

    channel: int
    sequence: int
    log_ns: int
    publish_ns: int
    data: bytes


def spans(file: ByteFile) -> Iterator[Span]:
    """The records of a file up to its footer.

    Raises:
        CutShortError: the file ends within a record.
        DamagedError: the file does not begin as MCAP does, or a record has an unknown opcode.
    """
    magic = file.read(0, len(MAGIC))
    if magic != MAGIC[: len(magic)]:
        raise DamagedError('it does not begin as an MCAP file does')
    at = len(MAGIC)
    while True:
        span = span_at(file, at)
        yield span
        if span.opcode == Opcode.FOOTER:
            return
        at = span.end


def span_at(file: ByteFile, at: int) -> Span:
    """The record at an offset.

    Raises:
        CutShortError: the file ends before the record does.
        DamagedError: the record has an unknown opcode.
    """
    opening = file.read(at, _PREFIX.size)
    if len(opening) < _PREFIX.size:
        raise CutShortError
    opcode, length = _PREFIX.unpack(opening)
    if not Opcode.HEADER <= opcode <= Opcode.DATA_END and opcode < _PRIVATE:
        raise DamagedError(f'a record has the unknown opcode {opcode}')
    begin = at + _PREFIX.size
    if begin + length > file.size:
        raise CutShortError
    return Span(opcode, begin, begin + length)


def raw_record(file: ByteFile, span: Span) -> RawRecord:
    """The record with its bytes."""
    return RawRecord(span.opcode, file.read(span.begin, span.end - span.begin))


def message(body: bytes) -> RawMessage:
    """Parses the bytes of a message record.

    Raises:
        DamagedError: there are too few bytes.
    """
    if len(body) < _MESSAGE.size:
        raise DamagedError('a message is too short')
    channel, sequence, log_ns, publish_ns = _MESSAGE.unpack_from(body)
    return RawMessage(channel, sequence, log_ns, publish_ns, body[_MESSAGE.size :])
