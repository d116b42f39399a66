"""The topics of a bag, and the channels and schemas of a bag that is being written."""

from collections.abc import Mapping
from dataclasses import dataclass

from mcap.writer import Writer

from push_bag.file.rosbag2_metadata import TopicSummary


@dataclass(frozen=True)
class Topic:
    """A topic as the bag describes it.

    Attributes:
        name: full name.
        type_name: in three parts.
        qos: the offered profiles as rosbag2's YAML list.
        type_hash: `RIHS01_…`; empty if the bag has none.
        schema: `ros2msg` definition of the type and all nested types.
    """

    name: str
    type_name: str
    qos: str
    type_hash: str
    schema: str = ''


class TopicRegistry:
    """Writes each topic to a file once."""

    def __init__(self, writer: Writer) -> None:
        self._writer = writer
        self._topics: dict[str, Topic] = {}
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}

    def add(self, topic: Topic) -> None:
        """Writes the channel of a topic, and its schema unless the file has it.

        Raises:
            OSError: the file cannot be written.
        """
        self._topics[topic.name] = topic
        self._channels[topic.name] = self._writer.register_channel(
            topic.name,
            'cdr',
            self._schema(topic),
            {'offered_qos_profiles': topic.qos, 'topic_type_hash': topic.type_hash},
        )

    def channel(self, name: str) -> int:
        """Number of a topic's channel."""
        return self._channels[name]

    def summaries(self, counts: Mapping[str, int]) -> list[TopicSummary]:
        """The topics as `metadata.yaml` lists them.

        Args:
            counts: messages by topic.
        """
        return [
            TopicSummary(topic.name, topic.type_name, topic.qos, topic.type_hash, counts[name])
            for name, topic in self._topics.items()
        ]

    def _schema(self, topic: Topic) -> int:
        if topic.type_name not in self._schemas:
            text = topic.schema.encode()
            number = self._writer.register_schema(topic.type_name, 'ros2msg', text)
            self._schemas[topic.type_name] = number
        return self._schemas[topic.type_name]
