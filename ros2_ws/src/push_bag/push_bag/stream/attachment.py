"""Attached files: found in the bag, and read from it block by block."""

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from mcap.opcode import Opcode
from mcap.records import AttachmentIndex

from push_bag.stream.byte_file import ByteFile
from push_bag.stream.records import DamagedError, Span

_TIMES = struct.Struct('<QQ')
_LENGTH = struct.Struct('<I')
_LONG_LENGTH = struct.Struct('<Q')


@dataclass(frozen=True)
class Attachment:
    """A file attached to a bag; its data stay in the bag until they are read.

    Attributes:
        name: of the attached file.
        media_type: such as `image/png`.
        log_ns: when it was recorded [ns].
        create_ns: when it was created [ns]; 0 if unknown.
        path: of the bag.
        begin, end: offsets of the data in the bag.
    """

    name: str
    media_type: str
    log_ns: int
    create_ns: int
    path: Path
    begin: int
    end: int

    @property
    def size(self) -> int:
        """Length of the data [B]."""
        return self.end - self.begin

    @property
    def data(self) -> bytes:
        """All data at once."""
        return b''.join(self.blocks())

    def blocks(self) -> Iterator[bytes]:
        """The data in pieces."""
        with ByteFile(self.path) as file:
            yield from file.blocks(self.begin, self.end)


def attachment(file: ByteFile, span: Span) -> Attachment:
    """The attachment in a record.

    Raises:
        DamagedError: a length in the record is impossible.
    """
    log_ns, create_ns = _TIMES.unpack(_piece(file, span, span.begin, _TIMES.size))
    name, at = _text(file, span, span.begin + _TIMES.size)
    media_type, at = _text(file, span, at)
    (length,) = _LONG_LENGTH.unpack(_piece(file, span, at, _LONG_LENGTH.size))
    begin = at + _LONG_LENGTH.size
    if begin + length + _LENGTH.size != span.end:
        raise DamagedError('a record is not readable (an attachment states a wrong length)')
    return Attachment(name, media_type, log_ns, create_ns, file.path, begin, begin + length)


def is_intact(file: ByteFile, span: Span) -> bool:
    """Whether an attachment's checksum is right or absent."""
    if span.end - span.begin < _LENGTH.size:
        return False
    (stated,) = _LENGTH.unpack(file.read(span.end - _LENGTH.size, _LENGTH.size))
    checksum = 0
    for block in file.blocks(span.begin, span.end - _LENGTH.size) if stated else ():
        checksum = zlib.crc32(block, checksum)
    return checksum == int(stated)


def write_attachment(stream: IO[bytes], attached: Attachment) -> AttachmentIndex:
    """Writes the record of an attached file piece by piece; returns its entry of the index.

    Raises:
        OSError: the stream cannot be written.
    """
    name, media_type = attached.name.encode(), attached.media_type.encode()
    head = struct.pack(
        f'<QQI{len(name)}sI{len(media_type)}sQ',
        *(attached.log_ns, attached.create_ns),
        *(len(name), name, len(media_type), media_type, attached.size),
    )
    begin, checksum = stream.tell(), zlib.crc32(head)
    length = len(head) + attached.size + _LENGTH.size
    stream.write(struct.pack('<BQ', Opcode.ATTACHMENT, length) + head)
    for block in attached.blocks():
        checksum = zlib.crc32(block, checksum)
        stream.write(block)
    stream.write(_LENGTH.pack(checksum))
    return AttachmentIndex(
        offset=begin,
        length=stream.tell() - begin,
        create_time=attached.create_ns,
        log_time=attached.log_ns,
        data_size=attached.size,
        name=attached.name,
        media_type=attached.media_type,
    )


def _text(file: ByteFile, span: Span, at: int) -> tuple[str, int]:
    """A string, and the offset after it."""
    (length,) = _LENGTH.unpack(_piece(file, span, at, _LENGTH.size))
    text = _piece(file, span, at + _LENGTH.size, length)
    return text.decode('utf-8', 'replace'), at + _LENGTH.size + length


def _piece(file: ByteFile, span: Span, at: int, count: int) -> bytes:
    if at + count > span.end:
        raise DamagedError('a record is not readable (an attachment is too short)')
    return file.read(at, count)
