"""Names of topics as users write them, and the nodes at the ends of a topic."""

from push_node.graph.sources import (
    SINGLE_SOURCE,
    UNNAMED,
    publisher_names,
    second_source,
    subscriber_names,
)
from push_node.graph.topic_names import full_name

__all__ = [
    'SINGLE_SOURCE',
    'UNNAMED',
    'full_name',
    'publisher_names',
    'second_source',
    'subscriber_names',
]
