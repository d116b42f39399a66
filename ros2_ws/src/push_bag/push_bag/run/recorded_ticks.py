"""The ticks of a recorded controller: inputs and command of each."""

import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array
from push_node import interface
from push_node.endpoints import short_name

from push_bag.file import BagReader, Columns, Record
from push_bag.run.conversions import (
    POSE_FIELDS,
    STAMP,
    TWIST_FIELDS,
    planar_poses,
    positions,
    velocities,
)
from push_bag.run.parameter_changes import merged, parameter_changes
from push_bag.run.series import PAIRED, Stamped
from push_bag.run.topic_table import TopicTable

OBJECT_POSE = interface.OBJECT_POSE.short_name
TIP_POSE = interface.PUSHER_POSE.short_name
COMMAND = interface.PUSHER_VELOCITY_CMD.short_name
STATE = interface.CONTROLLER_STATE.short_name
PLAN = interface.NOMINAL_TRAJECTORY.short_name
_CONTROLLER = interface.CONTROLLER_STATE.publishers[0]
TICK_FIELDS = (*STAMP, 'tick', 'mode', 'exposure', 'now', 'model_id', 'stop_reason')


@dataclass(frozen=True)
class RecordedTick:
    """One tick of the controller.

    Attributes:
        number: count since the start of the node.
        stamp: of the poses that it answered, and of its command [ns].
        published: when its state was published [ns].
        mode: of the controller after the tick.
        exposure: of the poses [s]; NaN for a tick without poses.
        now: when the tick was computed [s].
        model_id: of the model in use.
        stop_reason: why the controller stopped; empty if it did not.
        object_pose: (3,) measured [m, m, rad]; None without poses, or if the bag lacks it.
        tip: (2,) measured [m] at a time nearest to that of the object; None likewise.
        velocity: (2,) commanded [m/s]; None if no command was sent or recorded.
        changes: parameters of the controller that changed since the tick before, by name.
    """

    number: int
    stamp: int
    published: int
    mode: int
    exposure: float
    now: float
    model_id: str
    stop_reason: str
    object_pose: Array | None
    tip: Array | None
    velocity: Array | None
    changes: Mapping[str, Any]


class RecordedRun:
    """A bag read as ticks.

    Attributes:
        reader: of the bag, read to its end.
    """

    def __init__(self, path: Path) -> None:
        """Reads the bag.

        Raises:
            InputError: there is no readable bag, or no tick of a controller in it.
        """
        self.reader = BagReader(path)
        self._names: list[tuple[str, str]] = []
        tables = {
            OBJECT_POSE: TopicTable(POSE_FIELDS, 3, planar_poses),
            TIP_POSE: TopicTable(POSE_FIELDS, 2, positions),
            COMMAND: TopicTable(TWIST_FIELDS, 2, velocities),
            STATE: TopicTable(TICK_FIELDS, 4, self._tick_values),
        }
        self._plans: list[Record] = []
        events: list[Record] = []
        controller = ''
        for record in self.reader.records():
            name = short_name(record.topic.name)
            if name == PLAN:
                self._plans.append(record)
            elif name in tables:
                tables[name].add(record)
            if name == STATE:
                controller = record.topic.name.removesuffix(STATE) + _CONTROLLER
            if name == interface.PARAMETER_EVENTS.short_name:
                events.append(record)
        rows = {name: table.in_log_order() for name, table in tables.items()}
        self._states = rows.pop(STATE)
        self._names = [self._names[row] for row in tables[STATE].log_order.tolist()]
        self._rows = rows
        self._by_stamp = {
            name: ByStamp(each.stamp.tolist(), each.published.tolist())
            for name, each in rows.items()
        }
        if not self._states.stamp.size:
            raise InputError(f'{path} holds no ticks of a controller')
        changes = parameter_changes(events)
        self._changes = [change for change in changes if change.node == controller]
        self._changed_at = [change.published for change in self._changes]

    def ticks(self, paired: int = PAIRED) -> Iterator[RecordedTick]:
        """All ticks in the order in which they were computed.

        Args:
            paired: difference of the stamps of object and tip [ns] that still pairs.
        """
        since = 0
        for row in np.argsort(self._states.published, kind='stable').tolist():
            until = bisect_left(self._changed_at, int(self._states.published[row]))
            yield self._tick(row, paired, merged(self._changes[since:until]))
            since = until

    @property
    def tip_poses(self) -> Stamped:
        """All poses of the tip (n, 2) [m], by stamp."""
        return self._rows[TIP_POSE].by_stamp()

    def plan_start(self, tick: RecordedTick) -> Array:
        """Pose (3,) at which the plan begins that was in effect at a tick.

        Raises:
            InputError: the bag holds no plan of that time.
        """
        before = [each for each in self._plans if each.publish_ns <= tick.published]
        if not before:
            raise InputError(f'{self.reader.path} lacks the plan that the controller followed')
        plan = max(before, key=lambda each: each.publish_ns).message()
        return np.array([plan.x[0], plan.y[0], plan.theta[0]])

    def __len__(self) -> int:
        return self._states.stamp.size

    def _tick(self, row: int, paired: int, changes: Mapping[str, Any]) -> RecordedTick:
        stamp, published = int(self._states.stamp[row]), int(self._states.published[row])
        number, mode, exposure, now = self._states.values[row].tolist()
        values = {name: self._values(name, stamp, published) for name in self._rows}
        if values[TIP_POSE] is None and not math.isnan(exposure):
            values[TIP_POSE] = self._values(TIP_POSE, stamp, published, paired)
        model_id, stop_reason = self._names[row]
        return RecordedTick(
            number=int(number),
            stamp=stamp,
            published=published,
            mode=int(mode),
            exposure=exposure,
            now=now,
            model_id=model_id,
            stop_reason=stop_reason,
            object_pose=values[OBJECT_POSE],
            tip=values[TIP_POSE],
            velocity=values[COMMAND],
            changes=changes,
        )

    def _values(self, name: str, stamp: int, published: int, within: int = 0) -> Array | None:
        row = self._by_stamp[name].row(stamp, published, within)
        return None if row is None else np.asarray(self._rows[name].values[row])

    def _tick_values(self, columns: Columns) -> Array:
        self._names += zip(columns['model_id'], columns['stop_reason'], strict=True)
        return np.column_stack([columns[name] for name in ('tick', 'mode', 'exposure', 'now')])


class ByStamp:
    """Finds messages of a topic by stamp; a simulator that is reset repeats stamps."""

    def __init__(self, stamps: Sequence[int], published: Sequence[int]) -> None:
        """Indexes all messages by stamp.

        Args:
            stamps: of the messages in the order of the file [ns].
            published: their publish times [ns].
        """
        self._published = published
        self._ordered = sorted(zip(stamps, range(len(stamps)), strict=True))
        self._rows_by_stamp: dict[int, list[int]] = {}
        for row, stamp in enumerate(stamps):
            self._rows_by_stamp.setdefault(stamp, []).append(row)

    def row(self, stamp: int, time: int, within: int = 0) -> int | None:
        """Index of the last message with this stamp [ns] published until a time [ns].

        The first with this stamp if all were published later. Without any, that with the nearest
        stamp of those published until then; None if it is not within a time [ns].
        """
        rows = self._rows_by_stamp.get(stamp)
        if not rows:
            return self._nearest(stamp, time, within)
        published = [row for row in rows if self._published[row] <= time]
        return (published or rows[:1])[-1]

    def _nearest(self, stamp: int, time: int, within: int) -> int | None:
        low = bisect_left(self._ordered, (stamp - within, 0))
        high = bisect_left(self._ordered, (stamp + within + 1, 0))
        near = [each for each in self._ordered[low:high] if self._published[each[1]] <= time]
        if not near:
            return None
        return min(near, key=lambda each: (abs(each[0] - stamp), -each[0]))[1]
