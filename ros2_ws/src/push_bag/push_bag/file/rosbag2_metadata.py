"""Writes rosbag2's `metadata.yaml`; its presence marks a finished recording."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from push_core.common import write_atomically

from push_bag.file.yaml_text import from_yaml, to_yaml

VERSION = 9
FILE_NAME = 'metadata.yaml'


@dataclass(frozen=True)
class TopicSummary:
    """One topic as `metadata.yaml` lists it.

    Attributes:
        name: full name.
        type_name: in three parts.
        qos: rosbag2's YAML list of profiles.
        type_hash: `RIHS01_…`.
        encoding: of the messages, such as `cdr`.
        count: messages in the bag.
    """

    name: str
    type_name: str
    qos: str
    type_hash: str
    encoding: str
    count: int


@dataclass(frozen=True)
class TimeSpan:
    """First and last log time of a bag [ns]; both 0 if it is empty."""

    start_ns: int
    end_ns: int


def write_metadata(
    folder: Path,
    bag_name: str,
    topics: Sequence[TopicSummary],
    span: TimeSpan,
    facts: Mapping[str, str],
) -> None:
    """Writes `metadata.yaml` to the run's folder, completely or not at all.

    Args:
        folder: the run's folder.
        bag_name: name of the MCAP file in it.
        topics: every topic of the bag.
        span: of the log times.
        facts: of the run; they become rosbag2's custom data.

    Raises:
        InputError: the file cannot be written.
    """
    information = _information(bag_name, topics, span) | {'custom_data': dict(facts) or None}
    text = to_yaml({'rosbag2_bagfile_information': information})
    write_atomically(folder / FILE_NAME, text.encode())


def _information(bag_name: str, topics: Sequence[TopicSummary], span: TimeSpan) -> dict[str, Any]:
    count = sum(topic.count for topic in topics)
    return {
        'version': VERSION,
        'storage_identifier': 'mcap',
        **_contents(count, span),
        'topics_with_message_count': [_topic(topic) for topic in topics],
        'compression_format': '',
        'compression_mode': '',
        'relative_file_paths': [bag_name],
        'files': [{'path': bag_name, **_contents(count, span)}],
        'ros_distro': os.environ.get('ROS_DISTRO', 'jazzy'),
    }


def _contents(count: int, span: TimeSpan) -> dict[str, Any]:
    return {
        'starting_time': {'nanoseconds_since_epoch': span.start_ns},
        'duration': {'nanoseconds': span.end_ns - span.start_ns},
        'message_count': count,
    }


def _topic(topic: TopicSummary) -> dict[str, Any]:
    return {
        'topic_metadata': {
            'name': topic.name,
            'type': topic.type_name,
            'serialization_format': topic.encoding,
            'offered_qos_profiles': _profiles(topic.qos),
            'type_description_hash': topic.type_hash,
        },
        'message_count': topic.count,
    }


def _profiles(qos: str) -> list[Any]:
    """The profiles of a topic; none where a recovered bag's text is damaged."""
    try:
        profiles = from_yaml(qos)
    except yaml.YAMLError:
        return []
    return profiles if isinstance(profiles, list) else []
