"""Topics, facts, attachments and message counts of a bag, collected from its records."""

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

# what the mcap library raises for a damaged record
UNREADABLE = (McapError, ValueError, KeyError, TypeError, OverflowError, struct.error)


class BagContents:
    """What a bag states about itself, filled record by record.

    Attributes:
        topics: by channel number.
        facts: of the run.
        attachments: files by name.
        finished: whether the file has its footer.
        counts: received and lost messages by topic, as the recorder wrote them (JSON).
        middleware_lost: messages by topic that the middleware reported as lost.
        statistics: the file's statistics record; None where it has none.
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
        self._readers: dict[int, Callable[[ReadDataStream], None]] = {
            Opcode.SCHEMA: self._read_schema,
            Opcode.CHANNEL: self._read_channel,
            Opcode.METADATA: self._read_metadata,
            Opcode.ATTACHMENT: self._read_attachment,
            Opcode.STATISTICS: self._read_statistics,
            Opcode.FOOTER: self._read_footer,
        }

    def add(self, record: RawRecord) -> None:
        """Reads a record; messages and indices are ignored.

        Raises:
            DamagedError: the record cannot be parsed.
        """
        read = self._readers.get(record.opcode)
        if read is None:
            return
        try:
            read(ReadDataStream(BytesIO(record.body)))
        except UNREADABLE as error:
            raise DamagedError(f'a record is not readable ({error})') from None

    def _read_schema(self, body: ReadDataStream) -> None:
        schema = Schema.read(body)
        self._schemas.setdefault(schema.id, schema)

    def _read_channel(self, body: ReadDataStream) -> None:
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

    def _read_metadata(self, body: ReadDataStream) -> None:
        metadata = Metadata.read(body)
        if metadata.name == FACTS_RECORD:
            self.facts = dict(metadata.metadata)
        elif metadata.name == COUNTS_RECORD:
            self._read_counts(metadata.metadata)

    def _read_counts(self, counts: dict[str, str]) -> None:
        stated = {topic: json.loads(text)['middleware_lost'] for topic, text in counts.items()}
        self.middleware_lost = {
            topic: int(lost) for topic, lost in stated.items() if lost is not None
        }
        self.counts = dict(counts)

    def _read_attachment(self, body: ReadDataStream) -> None:
        attachment = Attachment.read(body)
        self.attachments[attachment.name] = attachment.data

    def _read_statistics(self, body: ReadDataStream) -> None:
        self.statistics = Statistics.read(body)

    def _read_footer(self, _body: ReadDataStream) -> None:
        self.finished = True
