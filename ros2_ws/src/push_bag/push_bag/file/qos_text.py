"""QoS profiles to and from the YAML list that rosbag2 stores."""

from enum import Enum
from typing import Any

import yaml
from push_core.common import InputError
from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    InvalidQoSProfileException,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)

from push_bag.file.yaml_text import from_yaml, to_yaml

POLICIES: dict[str, type[Enum]] = {
    'history': HistoryPolicy,
    'reliability': ReliabilityPolicy,
    'durability': DurabilityPolicy,
    'liveliness': LivelinessPolicy,
}
DURATIONS = ('deadline', 'lifespan', 'liveliness_lease_duration')
SECOND = 1_000_000_000
UNREADABLE = (
    *(yaml.YAMLError, KeyError, TypeError, ValueError, AttributeError, OverflowError),
    InvalidQoSProfileException,
)
UNKNOWN_DEPTH = 10  # discovery does not give the depth, so replay takes the default of ROS


def qos_text(profile: QoSProfile) -> str:
    """A YAML list with one profile, for `BagWriter.add_topic`."""
    words: dict[str, Any] = {
        name: kind(getattr(profile, name)).name.lower() for name, kind in POLICIES.items()
    }
    words |= {name: _seconds(getattr(profile, name)) for name in DURATIONS}
    words |= {
        'depth': profile.depth,
        'avoid_ros_namespace_conventions': profile.avoid_ros_namespace_conventions,
    }
    return to_yaml([words])


def qos_profile(text: str) -> QoSProfile:
    """The first profile of a YAML list; a default profile if the list is empty.

    Raises:
        InputError: the text is not a list of profiles as rosbag2 writes it.
    """
    try:
        profiles = from_yaml(text) or []
        return _profile(profiles[0]) if profiles else QoSProfile(depth=UNKNOWN_DEPTH)
    except UNREADABLE:
        raise InputError(f'not a list of QoS profiles: {text[:60]!r}') from None


def _profile(words: dict[str, Any]) -> QoSProfile:
    policies = {name: _policy(kind, words[name]) for name, kind in POLICIES.items()}
    durations = {name: _duration(words[name]) for name in DURATIONS}
    if policies['history'] not in (HistoryPolicy.KEEP_LAST, HistoryPolicy.KEEP_ALL):
        policies['history'] = HistoryPolicy.KEEP_LAST
    return QoSProfile(depth=int(words['depth']) or UNKNOWN_DEPTH, **policies, **durations)


def _policy(kind: type[Enum], value: str | int) -> Enum:
    return kind(value) if isinstance(value, int) else kind[value.upper()]


def _seconds(duration: Duration) -> dict[str, int]:
    return {
        'sec': duration.nanoseconds // SECOND,
        'nsec': duration.nanoseconds % SECOND,
    }


def _duration(words: dict[str, int]) -> Duration:
    return Duration(nanoseconds=words['sec'] * SECOND + words['nsec'])
