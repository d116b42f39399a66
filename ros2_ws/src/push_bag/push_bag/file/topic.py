"""A topic as a bag describes it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Topic:
    """A topic as the bag describes it.

    Attributes:
        name: full name.
        type_name: in three parts.
        qos: the offered profiles as rosbag2's YAML list.
        type_hash: `RIHS01_…`, empty where the bag has none.
        schema: the type's definition, with all that it is made of.
    """

    name: str
    type_name: str
    qos: str
    type_hash: str
    schema: str = ''
