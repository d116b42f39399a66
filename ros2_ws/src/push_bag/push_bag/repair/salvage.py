"""Finds the intact records of a damaged MCAP file.

Chunks have checksums, so an intact chunk is recognised anywhere. After damaged bytes the search
continues at each byte that may begin a chunk. A record without a checksum is rejected if an intact
chunk begins within the length that it states. So every intact chunk is found.
"""

from collections.abc import Iterator
from typing import NamedTuple

from mcap.opcode import Opcode

from push_bag.stream import (
    MAGIC,
    Attachment,
    ByteFile,
    Chunk,
    CutShortError,
    DamagedError,
    RawRecord,
    Span,
    attachment,
    chunk,
    is_intact,
    raw_record,
    span_at,
    verify,
)

_FIRST_BYTE = bytes([Opcode.CHUNK])


class Damage(NamedTuple):
    """Bytes that belong to no intact record."""

    at: int
    length: int


class PrivateRecord(NamedTuple):
    """A record that only the program knows which wrote the file."""

    opcode: int


Part = Chunk | Attachment | RawRecord | PrivateRecord | Damage


def parts_of(file: ByteFile) -> Iterator[Part]:
    """Intact parts and damaged ranges, in the order of the file."""
    at = len(MAGIC) if file.read(0, len(MAGIC)) == MAGIC else 0
    tail = file.read(max(file.size - len(MAGIC), 0), len(MAGIC))
    end = file.size - (len(MAGIC) if tail == MAGIC else 0)
    while at < end:
        part, after = _part_at(file, at)
        if part is None:
            after = _next_chunk(file, at + 1, file.size)
        yield part or Damage(at, after - at)
        at = after


def _part_at(file: ByteFile, at: int) -> tuple[Part | None, int]:
    """The intact part at an offset, None without one, and the offset of its end."""
    try:
        span = span_at(file, at)
        return _part(file, at, span), span.end
    except (CutShortError, DamagedError):
        return None, at


def _part(file: ByteFile, at: int, span: Span) -> Part | None:
    if span.opcode == Opcode.CHUNK:
        return _intact(file, span)
    if span.opcode == Opcode.ATTACHMENT:
        return attachment(file, span) if is_intact(file, span) else None
    if _next_chunk(file, at + 1, span.end) < span.end:
        return None
    return PrivateRecord(span.opcode) if span.is_private else raw_record(file, span)


def _next_chunk(file: ByteFile, begin: int, end: int) -> int:
    """Offset of the next intact chunk; `end` if none begins before it."""
    at = file.find(_FIRST_BYTE, begin, end)
    while at >= 0:
        if _is_chunk(file, at):
            return at
        at = file.find(_FIRST_BYTE, at + 1, end)
    return end


def _is_chunk(file: ByteFile, at: int) -> bool:
    try:
        span = span_at(file, at)
        return _intact(file, span) is not None
    except (CutShortError, DamagedError):
        return False


def _intact(file: ByteFile, span: Span) -> Chunk | None:
    """The chunk in a record; None if its lengths disagree.

    Raises:
        DamagedError: it is damaged.
    """
    found = chunk(file, span)
    if found.end != span.end:
        return None
    verify(found)
    return found
