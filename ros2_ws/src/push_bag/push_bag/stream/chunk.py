"""Chunks: decompressed block by block, so that a chunk of any size takes little memory."""

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import lz4.frame
import zstandard
from mcap.opcode import Opcode

from push_bag.stream.byte_file import WINDOW, ByteFile
from push_bag.stream.records import DamagedError, RawMessage, RawRecord, Span, message

BLOCK = 4 << 20  # [B] decompressed at once; most chunks are smaller
_PREFIX = struct.Struct('<BQ')
_HEAD = struct.Struct('<QQQII')
_LONG_LENGTH = struct.Struct('<Q')
_LONGEST_NAME = 4  # of a compression
COMPRESSIONS = (b'', b'zstd', b'lz4')


@dataclass(frozen=True)
class Chunk:
    """A chunk record in a file.

    Attributes:
        file: that holds it.
        compression: its name.
        size: of the decompressed data, as stated [B].
        checksum: CRC-32 of the decompressed data; 0 without one.
        begin, end: offsets of the compressed data.
    """

    file: ByteFile
    compression: bytes
    size: int
    checksum: int
    begin: int
    end: int

    def blocks(self) -> Iterator[bytes]:
        """The decompressed data in blocks, its size and its checksum verified at the end.

        Raises:
            DamagedError: the data do not decompress, or size or checksum are wrong.
        """
        total, checksum = 0, 0
        for block in self._decompressed():
            total += len(block)
            checksum = zlib.crc32(block, checksum)
            if total > self.size:
                raise DamagedError('a chunk is larger than it states')
            yield block
        if total != self.size or (self.checksum and checksum != self.checksum):
            raise DamagedError('the checksum of a chunk is wrong')

    def _decompressed(self) -> Iterator[bytes]:
        if not self.compression:
            yield from self.file.blocks(self.begin, self.end)
            return
        source = _Source(self.file.blocks(self.begin, self.end))
        opened = _zstd if self.compression == b'zstd' else lz4.frame.open
        try:
            stream = opened(source)
            while block := stream.read(BLOCK):
                yield block
        except (zstandard.ZstdError, RuntimeError, ValueError, EOFError) as error:
            raise DamagedError(f'a chunk does not decompress: {error}') from None


def chunk(file: ByteFile, span: Span) -> Chunk:
    """The chunk in a record.

    Raises:
        DamagedError: its lengths do not agree, or its compression is unknown.
    """
    head = file.read(span.begin, _HEAD.size + _LONGEST_NAME + _LONG_LENGTH.size)
    try:
        _, _, size, checksum, name_length = _HEAD.unpack_from(head)
        name_end = _HEAD.size + name_length
        (length,) = _LONG_LENGTH.unpack_from(head, name_end)
    except struct.error:
        raise DamagedError('a chunk has an unknown compression, or is too short') from None
    name = head[_HEAD.size : name_end]
    if name not in COMPRESSIONS:
        raise DamagedError('a chunk has an unknown compression')
    begin = span.begin + name_end + _LONG_LENGTH.size
    if begin + length > span.end:
        raise DamagedError('a chunk states a size that it cannot have')
    return Chunk(file, name, size, checksum, begin, begin + length)


def verify(each: Chunk) -> None:
    """Decompresses a chunk and forgets it.

    Raises:
        DamagedError: the data do not decompress, or size or checksum are wrong.
    """
    for _ in each.blocks():
        pass


def chunk_records(each: Chunk) -> Iterator[RawMessage | RawRecord]:
    """Messages, schemas and channels of a chunk.

    Raises:
        DamagedError: the chunk is damaged, or a record is longer than the rest of the chunk.
    """
    data, at, left = b'', 0, each.size
    for block in each.blocks():
        data, at = (data[at:] + block if at < len(data) else block), 0
        end = len(data)
        while end - at >= _PREFIX.size:
            opcode, length = _PREFIX.unpack_from(data, at)
            after = at + _PREFIX.size + length
            if after - at > left:
                raise DamagedError('a record is longer than its chunk')
            if after > end:
                break
            body = data[at + _PREFIX.size : after]
            yield message(body) if opcode == Opcode.MESSAGE else RawRecord(opcode, body)
            left -= after - at
            at = after
    if left:
        raise DamagedError('a chunk ends within a record')


class _Source:
    """Blocks of compressed data as a file for the decompressors."""

    def __init__(self, blocks: Iterator[bytes]) -> None:
        self._blocks = blocks
        self._rest = b''

    def read(self, count: int = -1) -> bytes:
        """At most `count` bytes, and at most one block; nothing at the end."""
        data = self._rest or next(self._blocks, b'')
        wanted = WINDOW if count < 0 else count
        self._rest = data[wanted:]
        return data[:wanted]


def _zstd(source: Any) -> Any:
    return zstandard.ZstdDecompressor().stream_reader(source, read_across_frames=True)
