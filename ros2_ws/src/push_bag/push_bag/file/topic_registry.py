"""The topics of a bag, and the channels and schemas of a bag that is being written."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field

from mcap.writer import Writer

from push_bag.file.message_types import Definition
from push_bag.file.rosbag2_metadata import TopicSummary

QOS = 'offered_qos_profiles'
TYPE_HASH = 'topic_type_hash'


@dataclass(frozen=True)
class Schema:
    """The definition of a type as the bag states it.

    Attributes:
        name: of the type; in three parts, `geometry_msgs/msg/PoseStamped`, in bags of ROS 2.
        encoding: of the definition, such as `ros2msg`, `ros2idl` or `jsonschema`.
        data: the definition.
    """

    name: str
    encoding: str
    data: bytes


@dataclass(frozen=True)
class Topic:
    """A topic as one channel of the bag describes it.

    Attributes:
        name: full name.
        definition: of its type; None if the channel has none.
        encoding: of the messages, such as `cdr` or `json`.
        metadata: of the channel.
    """

    name: str
    definition: Schema | None
    encoding: str = 'cdr'
    metadata: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of_ros(cls, name: str, type_name: str, qos: str, definition: Definition) -> 'Topic':
        """A topic as rosbag2 describes it.

        Args:
            name: full name.
            type_name: in three parts.
            qos: the offered profiles as rosbag2's YAML list.
            definition: of the type.
        """
        schema = Schema(type_name, 'ros2msg', definition.schema.encode())
        return cls(name, schema, 'cdr', {QOS: qos, TYPE_HASH: definition.type_hash})

    @property
    def type_name(self) -> str:
        """Name of the type; empty without one."""
        return self.definition.name if self.definition else ''

    @property
    def qos(self) -> str:
        """The offered profiles as rosbag2's YAML list."""
        return self.metadata.get(QOS, '')

    @property
    def type_hash(self) -> str:
        """`RIHS01_…`; empty if the bag has none."""
        return self.metadata.get(TYPE_HASH, '')

    @property
    def schema(self) -> str:
        """The definition of the type and all nested types as text."""
        return self.definition.data.decode('utf-8', 'replace') if self.definition else ''


class TopicRegistry:
    """Writes channels to a file, and each schema once."""

    def __init__(self, writer: Writer) -> None:
        self._writer = writer
        self._topics: dict[int, Topic] = {}
        self._schemas: dict[Schema, int] = {}

    def add(self, topic: Topic) -> int:
        """Writes a channel, and its schema unless the file has it; returns its number.

        Raises:
            OSError: the file cannot be written.
        """
        channel = self._writer.register_channel(
            topic.name, topic.encoding, self._schema(topic.definition), dict(topic.metadata)
        )
        self._topics[channel] = topic
        return channel

    def topic(self, channel: int) -> Topic:
        """The topic of a channel."""
        return self._topics[channel]

    def summaries(self, counts: Mapping[int, int]) -> list[TopicSummary]:
        """The topics as `metadata.yaml` lists them, channels of one topic and type as one.

        Args:
            counts: messages by channel.
        """
        totals = Counter[tuple[str, str, str, str, str]]()
        for channel, topic in self._topics.items():
            described = (topic.name, topic.type_name, topic.qos, topic.type_hash, topic.encoding)
            totals[described] += counts.get(channel, 0)
        return [TopicSummary(*described, count) for described, count in totals.items()]

    def _schema(self, schema: Schema | None) -> int:
        """Number of a schema; 0 means that a channel has none."""
        if schema is None:
            return 0
        if schema not in self._schemas:
            self._schemas[schema] = self._writer.register_schema(
                schema.name, schema.encoding, schema.data
            )
        return self._schemas[schema]
