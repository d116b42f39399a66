"""Topics, facts, attachments and message counts of an MCAP file, collected from its records."""

import json
import struct
from collections.abc import Callable
from io import BytesIO

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Channel, Header, Metadata, Statistics
from mcap.records import Schema as SchemaRecord

from push_bag.file.bag_writer import COUNTS_RECORD, FACTS_RECORD
from push_bag.file.topic_registry import Schema, Topic
from push_bag.stream import Attachment, DamagedError, RawRecord

# what the mcap library raises for a damaged record
UNREADABLE = (McapError, ValueError, KeyError, TypeError, OverflowError, struct.error)


class BagContents:
    """What a file states about itself, filled record by record.

    Attributes:
        topics: by channel number.
        schemas: by schema number.
        metadata: name and values of each metadata record.
        attachments: attached files.
        finished: whether the file has its footer.
        profile: of the header; empty without one.
        statistics: the file's statistics record; None where it has none.
        without_schema: names of topics whose schema is missing.
    """

    def __init__(self) -> None:
        self.topics: dict[int, Topic] = {}
        self.schemas: dict[int, Schema] = {}
        self.metadata: list[tuple[str, dict[str, str]]] = []
        self.attachments: list[Attachment] = []
        self.finished = False
        self.profile = ''
        self.statistics: Statistics | None = None
        self.without_schema: list[str] = []
        self._readers: dict[int, Callable[[ReadDataStream], None]] = {
            Opcode.HEADER: self._read_header,
            Opcode.SCHEMA: self._read_schema,
            Opcode.CHANNEL: self._read_channel,
            Opcode.METADATA: self._read_metadata,
            Opcode.STATISTICS: self._read_statistics,
            Opcode.FOOTER: self._read_footer,
        }

    @property
    def facts(self) -> dict[str, str]:
        """The facts of the run; of several records the first one that states a fact counts."""
        facts: dict[str, str] = {}
        for name, values in self.metadata:
            if name == FACTS_RECORD:
                facts = {**values, **facts}
        return facts

    @property
    def middleware_lost(self) -> dict[str, int]:
        """Messages by topic that the middleware reported as lost, as the recorder wrote them."""
        lost: dict[str, int] = {}
        for name, values in self.metadata:
            for topic, text in values.items() if name == COUNTS_RECORD else ():
                count = _middleware_lost(text)
                if count is not None:
                    lost[topic] = count
        return lost

    def reads(self, opcode: int) -> bool:
        """Whether `add` reads records of this kind."""
        return opcode in self._readers

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

    def _read_header(self, body: ReadDataStream) -> None:
        self.profile = Header.read(body).profile

    def _read_schema(self, body: ReadDataStream) -> None:
        schema = SchemaRecord.read(body)
        self.schemas.setdefault(schema.id, Schema(schema.name, schema.encoding, schema.data))

    def _read_channel(self, body: ReadDataStream) -> None:
        channel = Channel.read(body)
        if channel.id in self.topics:
            return
        schema = self.schemas.get(channel.schema_id)
        if channel.schema_id and schema is None:
            self.without_schema.append(channel.topic)
        self.topics[channel.id] = Topic(
            channel.topic, schema, channel.message_encoding, dict(channel.metadata)
        )

    def _read_metadata(self, body: ReadDataStream) -> None:
        metadata = Metadata.read(body)
        self.metadata.append((metadata.name, dict(metadata.metadata)))

    def _read_statistics(self, body: ReadDataStream) -> None:
        self.statistics = Statistics.read(body)

    def _read_footer(self, _body: ReadDataStream) -> None:
        self.finished = True


def _middleware_lost(text: str) -> int | None:
    """The count in our recorder's JSON; None in what another program wrote by this name."""
    try:
        count = json.loads(text)['middleware_lost']
    except (ValueError, TypeError, KeyError):
        return None
    return count if isinstance(count, int) else None
