"""What the records of a bag say of it: topics, facts, attachments, and how much it should hold."""

import json
import struct
from collections.abc import Callable
from io import BytesIO

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Metadata, Schema, Statistics

from push_bag.file.bag_writer import COUNTS_RECORD, FACTS_RECORD
from push_bag.file.mcap_stream import DamagedError, RawRecord
from push_bag.file.topic_registry import Topic


class BagContents:
    """Takes notes while the records of a bag go by.

    Attributes:
        topics: by the number of their channel.
        facts: of the run.
        attachments: whole files by name.
        finished: whether the file came to its proper end.
        counts: what the recorder received and lost by topic, as it wrote it down.
        middleware_lost: messages by topic of which the middleware told the recorder.
        statistics: what the file says it holds; None where it does not say.
    """

    def __init__(self) -> None:
        self.topics: dict[int, Topic] = {}
        self.facts: dict[str, str] = {}
        self.attachments: dict[str, bytes] = {}
        self.finished = False
        self.counts: dict[str, str] = {}
        self.middleware_lost: dict[str, int] = {}
        self.statistics: Statistics | None = None
        self._schemas: dict[int, Schema] = {}
        self._note: dict[int, Callable[[ReadDataStream], None]] = {
            Opcode.SCHEMA: self._note_schema,
            Opcode.CHANNEL: self._note_channel,
            Opcode.METADATA: self._note_metadata,
            Opcode.ATTACHMENT: self._note_attachment,
            Opcode.STATISTICS: self._note_statistics,
            Opcode.FOOTER: self._note_end,
        }

    def note(self, record: RawRecord) -> None:
        """Remembers what a record says; a record of another kind says nothing.

        Raises:
            DamagedError: it cannot be read.
        """
        note = self._note.get(record.opcode)
        if note is None:
            return
        try:
            note(ReadDataStream(BytesIO(record.body)))
        except (McapError, ValueError, KeyError, TypeError, struct.error) as error:
            raise DamagedError(f'a record is not readable ({error})') from None

    def _note_schema(self, body: ReadDataStream) -> None:
        schema = Schema.read(body)
        self._schemas.setdefault(schema.id, schema)

    def _note_channel(self, body: ReadDataStream) -> None:
        channel = Channel.read(body)
        if channel.id in self.topics:
            return
        schema = self._schemas.get(channel.schema_id)
        self.topics[channel.id] = Topic(
            channel.topic,
            schema.name if schema else '',
            channel.metadata.get('offered_qos_profiles', ''),
            channel.metadata.get('topic_type_hash', ''),
            schema.data.decode('utf-8', 'replace') if schema else '',
        )

    def _note_metadata(self, body: ReadDataStream) -> None:
        metadata = Metadata.read(body)
        if metadata.name == FACTS_RECORD:
            self.facts = dict(metadata.metadata)
        elif metadata.name == COUNTS_RECORD:
            self._note_counts(metadata.metadata)

    def _note_counts(self, counts: dict[str, str]) -> None:
        told = {topic: json.loads(text)['middleware_lost'] for topic, text in counts.items()}
        self.middleware_lost = {
            topic: int(lost) for topic, lost in told.items() if lost is not None
        }
        self.counts = dict(counts)

    def _note_attachment(self, body: ReadDataStream) -> None:
        attachment = Attachment.read(body)
        self.attachments[attachment.name] = attachment.data

    def _note_statistics(self, body: ReadDataStream) -> None:
        self.statistics = Statistics.read(body)

    def _note_end(self, _body: ReadDataStream) -> None:
        self.finished = True
