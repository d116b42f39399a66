"""The topics of a bag that is being written: their channels, schemas and second copies."""

import json
import zlib
from collections.abc import Mapping

from mcap.writer import Writer

from push_bag.file.rosbag2_metadata import TopicSummary
from push_bag.file.topic import Topic

TOPIC_RECORD = 'topic'  # a second copy, for whoever has to do without the first chunk


class TopicRegistry:
    """Makes topics known to a file, each once."""

    def __init__(self, writer: Writer) -> None:
        self._writer = writer
        self._topics: dict[str, Topic] = {}
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}

    def add(self, topic: Topic) -> None:
        """Writes down a topic; the copy stands outside the chunks and has a checksum.

        Raises:
            OSError: the file cannot be written.
        """
        told = {'offered_qos_profiles': topic.qos, 'topic_type_hash': topic.type_hash}
        number = self._writer.register_channel(topic.name, 'cdr', self._schema(topic), told)
        copy = json.dumps({'id': number, 'name': topic.name, 'type': topic.type_name, **told})
        checksum = str(zlib.crc32(copy.encode()))
        self._writer.add_metadata(TOPIC_RECORD, {'topic': copy, 'crc32': checksum})
        self._topics[topic.name], self._channels[topic.name] = topic, number

    def channel(self, name: str) -> int:
        """Number of a topic's channel."""
        return self._channels[name]

    def summaries(self, counts: Mapping[str, int]) -> list[TopicSummary]:
        """What `metadata.yaml` tells of the topics.

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
