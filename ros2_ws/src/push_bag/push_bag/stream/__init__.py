"""The records of an MCAP file, read and written with bounded memory."""

from push_bag.stream.attachment import Attachment, attachment, is_intact, write_attachment
from push_bag.stream.byte_file import ByteFile
from push_bag.stream.chunk import Chunk, chunk, chunk_records, verify
from push_bag.stream.chunk_indexes import ChunkIndexes
from push_bag.stream.records import (
    MAGIC,
    CutShortError,
    DamagedError,
    RawMessage,
    RawRecord,
    Span,
    message,
    raw_record,
    span_at,
    spans,
)

__all__ = [
    'MAGIC',
    'Attachment',
    'ByteFile',
    'Chunk',
    'ChunkIndexes',
    'CutShortError',
    'DamagedError',
    'RawMessage',
    'RawRecord',
    'Span',
    'attachment',
    'chunk',
    'chunk_records',
    'is_intact',
    'message',
    'raw_record',
    'span_at',
    'spans',
    'verify',
    'write_attachment',
]
