"""The messages of one topic as a table that grows record by record."""

from array import array
from collections.abc import Callable, Collection, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray
from push_core.common import InputError

from push_bag.file import Columns, Leaf, Record, Topic, columns, leaves, schema_text
from push_bag.run.conversions import stamps
from push_bag.run.series import NEVER, Floats, Stamped

NONE: Mapping[str, int] = MappingProxyType({})
BATCH = 4096  # messages decoded at once; bounds the memory


class TopicTable:
    """Collects the messages of a topic and decodes them in batches."""

    def __init__(
        self,
        fields: Collection[str],
        width: int,
        values: Callable[[Columns], Floats],
        optional: Mapping[str, int] = NONE,
    ) -> None:
        """Starts empty.

        Args:
            fields: to decode, including those of the stamp.
            width: number k of values per message.
            values: converts the decoded fields to rows (n, k).
            optional: number of values of each further field that is NaN where the type of the
                bag, of an earlier version, lacks it.
        """
        self._fields = fields
        self._values = values
        self._optional = optional
        self._decoded = {*fields, *optional}
        self._blocks = [_no_rows(width)]
        self._topic: Topic | None = None
        self._layout: list[Leaf] = []
        self._messages: list[bytes] = []
        self._published: list[int] = []
        self._logged = array('Q')

    def add(self, record: Record) -> None:
        """Adds one message.

        Raises:
            InputError: a message is not of its topic's type.
        """
        if record.topic is not self._topic and record.topic != self._topic:
            self._begin(record.topic)
        self._messages.append(record.data)
        self._published.append(record.publish_ns)
        self._logged.append(record.log_ns)
        if len(self._messages) >= BATCH:
            self._decode()

    def stamped(self, begin: int = 0, end: int = NEVER) -> Stamped:
        """The messages ordered by stamp; of messages with equal stamps the first one.

        Args:
            begin: log time of the first message [ns].
            end: log time before which the messages end [ns].

        Raises:
            InputError: a message is not of its topic's type.
        """
        chosen = slice(*np.searchsorted(self.logged, (begin, end)).tolist())
        return self.in_log_order().rows(chosen).by_stamp()

    @property
    def logged(self) -> NDArray[np.int64]:
        """Log times (n,) of the messages [ns], in order."""
        return np.sort(np.frombuffer(self._logged, np.uint64)).astype(np.int64)

    @property
    def log_order(self) -> NDArray[np.intp]:
        """Indices (n,) that sort the messages of the file by log time."""
        return np.argsort(np.frombuffer(self._logged, np.uint64), kind='stable')

    def in_log_order(self) -> Stamped:
        """All messages in the order of their log times.

        Raises:
            InputError: a message is not of its topic's type.
        """
        self._decode()
        stamp, published, values = (
            np.concatenate([getattr(block, name) for block in self._blocks])
            for name in ('stamp', 'published', 'values')
        )
        order = self.log_order
        return Stamped(stamp[order], published[order], values[order])

    def _begin(self, topic: Topic) -> None:
        self._decode()
        self._topic = topic
        self._layout = leaves(_ros_schema(topic), topic.type_name.split('/')[0])
        known = {leaf.name for leaf in self._layout}
        missing = [name for name in self._fields if name not in known]
        if missing:
            raise InputError(f'{topic.name} is a {topic.type_name}, which has no {missing[0]}')
        self._decoded = {*self._fields, *(self._optional.keys() & known)}

    def _decode(self) -> None:
        if self._topic is None or not self._messages:
            return
        try:
            fields = columns(self._messages, self._layout, self._decoded)
        except ValueError as error:
            kind = self._topic.type_name
            raise InputError(f'a message on {self._topic.name} is not a {kind}: {error}') from None
        for name in self._optional.keys() - self._decoded:
            fields[name] = np.full((len(self._messages), self._optional[name]), np.nan)
        published = np.array(self._published, np.uint64).astype(np.int64)
        self._blocks.append(Stamped(stamps(fields), published, self._values(fields)))
        self._messages, self._published = [], []


def _ros_schema(topic: Topic) -> str:
    """The type's `ros2msg` schema; that of the installed type if the bag has another or none."""
    stated = topic.definition
    if stated is not None and stated.encoding == 'ros2msg' and stated.data.strip():
        return topic.schema
    return schema_text(topic.type_name)


def _no_rows(width: int) -> Stamped:
    nothing = np.zeros(0, np.int64)
    return Stamped(nothing, nothing, np.zeros((0, width)))
