"""Changes of a node's parameters during a run, from the recorded parameter events."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from rclpy.parameter import parameter_value_to_python

from push_bag.file import Record


@dataclass(frozen=True)
class ParameterChange:
    """One change, of parameters that were set together.

    Attributes:
        published: when the node published it, before its next callback [ns].
        node: full name of the node.
        values: by name.
    """

    published: int
    node: str
    values: Mapping[str, Any]


def parameter_changes(records: Iterable[Record]) -> list[ParameterChange]:
    """The changes in recorded parameter events, in the order of their time; no declarations."""
    return sorted(_changes(records), key=lambda change: change.published)


def merged(changes: Iterable[ParameterChange]) -> dict[str, Any]:
    """The values after some changes of one node, by name."""
    values: dict[str, Any] = {}
    for change in changes:
        values.update(change.values)
    return values


def _changes(records: Iterable[Record]) -> Iterator[ParameterChange]:
    for record in records:
        event = record.message()
        values = {
            each.name: parameter_value_to_python(each.value) for each in event.changed_parameters
        }
        if values:
            yield ParameterChange(record.publish_ns, event.node, values)
