"""Collects the records of a bag and turns them into the series of its starts."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import Any

import numpy as np
from push_core.common import InputError
from push_node import interface
from push_node.endpoints import GraphTopic, short_name

from push_bag.file import BagReader, Columns, Record, Traffic, TrafficLog, counted
from push_bag.run.conversions import (
    OPTIONAL_STATE_FIELDS,
    ORIENTED_POSE_FIELDS,
    POSE_FIELDS,
    STATE_FIELDS,
    TRUTH_FIELDS,
    TWIST_FIELDS,
    lesson,
    measured_poses,
    model,
    perturbation,
    positions,
    reference,
    ticks,
    true_poses,
    velocities,
)
from push_bag.run.parameter_changes import ParameterChange, parameter_changes
from push_bag.run.series import (
    NEVER,
    STATE_COLUMNS,
    DrivenLesson,
    Floats,
    ModelFacts,
    Reference,
    RunSeries,
    Stamped,
)
from push_bag.run.starts import Start, find_resets, find_starts
from push_bag.run.topic_table import TopicTable

COMMAND = interface.PUSHER_VELOCITY_CMD.short_name
STATE = interface.CONTROLLER_STATE.short_name
RARE = (
    interface.NOMINAL_TRAJECTORY.short_name,
    interface.MODEL_INFO.short_name,
    interface.LESSON.short_name,
    interface.PERTURBATION.short_name,
    interface.HORIZON.short_name,
    interface.RUN_END.short_name,
    interface.PARAMETER_EVENTS.short_name,
)
"""Topics that are read as messages."""


class RunRows:
    """Collects the rows of each series, record by record."""

    def __init__(self) -> None:
        self._tables = {
            interface.OBJECT_POSE.short_name: TopicTable(ORIENTED_POSE_FIELDS, 3, measured_poses),
            interface.PUSHER_POSE.short_name: TopicTable(POSE_FIELDS, 2, positions),
            interface.GROUND_TRUTH.short_name: TopicTable(TRUTH_FIELDS, 3, true_poses),
            COMMAND: TopicTable(TWIST_FIELDS, 2, velocities),
            STATE: TopicTable(
                STATE_FIELDS, len(STATE_COLUMNS), self._states, OPTIONAL_STATE_FIELDS
            ),
        }
        self._rare: dict[str, list[Record]] = {name: [] for name in RARE}
        self._topics: dict[str, tuple[TrafficLog, Callable[[Record], None] | None]] = {}
        self._sources: dict[str, str] = {}
        self._stop_reasons: list[str] = []
        self._model_ids: list[str] = []
        self._readers: Mapping[str, Callable[[Record], None]] = {
            **{name: table.add for name, table in self._tables.items()},
            **{name: records.append for name, records in self._rare.items()},
        }

    @property
    def is_empty(self) -> bool:
        """Whether there was no record."""
        return not self._topics

    def add(self, record: Record) -> None:
        """Counts a record and adds it to its series."""
        known = self._topics.get(record.topic.name)
        if known is None:
            known = self._topics[record.topic.name] = self._new_topic(record.topic.name)
        seen, read = known
        seen.add(record.sequence, record.log_ns)
        if read is not None:
            read(record)

    def starts(self) -> list[Start]:
        """Each start of the controller in order; all of the bag where there is none.

        Raises:
            InputError: a message is not of its topic's type.
        """
        rows = self._state_rows
        mode, tick = (
            rows.values[:, STATE_COLUMNS.index(name)].astype(np.int64) for name in ('mode', 'tick')
        )
        poses = self._tables[interface.OBJECT_POSE.short_name]
        resets = find_resets(poses.logged, poses.in_log_order().stamp)
        return find_starts(self._tables[STATE].logged, mode, tick, resets) or [self._whole()]

    def series(self, reader: BagReader, start: Start, reason: str) -> RunSeries:
        """The series of one start; its message counts are those of the bag.

        Args:
            reader: of the bag, read to its end.
            start: of the controller.
            reason: why the run ended early, empty for that of the controller.

        Raises:
            InputError: a message is not of its topic's type.
        """
        tables = {
            name: table.stamped(start.begin, start.end) for name, table in self._tables.items()
        }
        return RunSeries(
            facts=reader.facts,
            finished=reader.finished,
            traffic=self._traffic(reader),
            types={name: topic.type_name for name, topic in reader.topics.items()},
            object=tables[interface.OBJECT_POSE.short_name],
            truth=tables[interface.GROUND_TRUTH.short_name],
            pusher=tables[interface.PUSHER_POSE.short_name],
            commands=tables[COMMAND],
            states=self._state_rows.rows(start.ticks).by_stamp(),
            stop_reason=reason or self._stop_reason(start),
            foreign_commands=self._foreign_commands(start),
            reference=self._reference(start),
            model=self._model(start),
            lessons=tuple(self._lessons(start)),
            perturbations=tuple(
                perturbation(each.message())
                for each in self._within(interface.PERTURBATION, start)
            ),
            horizons=tuple(self._within(interface.HORIZON, start)),
            changes=tuple(self._changes(start)),
        )

    @property
    def end_reason(self) -> str:
        """Why the cell ended the run early; empty without a reason."""
        ends = self._sorted(interface.RUN_END)
        return str(ends[-1].message().data) if ends else ''

    @cached_property
    def _state_rows(self) -> Stamped:
        """The ticks in the order of their log times."""
        return self._tables[STATE].in_log_order()

    def _whole(self) -> Start:
        every = np.arange(self._state_rows.stamp.size)
        return Start(ticks=every, own=every, ran=(0, NEVER), begin=0, end=NEVER)

    def _traffic(self, reader: BagReader) -> dict[str, Traffic]:
        traffic = counted({name: log for name, (log, _) in self._topics.items()})
        for name, lost in reader.middleware_lost.items():
            traffic.setdefault(name, Traffic()).middleware_lost = lost
        return {name: traffic.get(name, Traffic()) for name in reader.topics}

    def _foreign_commands(self, start: Start) -> int:
        """Number of commands during a start that answer no tick of its controller."""
        first, after = np.searchsorted(self._tables[COMMAND].logged, start.ran)
        commands = self._tables[COMMAND].in_log_order().rows(slice(first, after))
        # a command that is sent again, with the same velocity, is the same command
        rows = np.column_stack([commands.stamp, commands.values.view(np.int64)])
        sent = Counter(np.unique(rows, axis=0)[:, 0].tolist())
        answered = Counter(self._state_rows.stamp[start.own].tolist())
        return (sent - answered).total()

    def _new_topic(self, name: str) -> tuple[TrafficLog, Callable[[Record], None] | None]:
        own = short_name(name)
        other = self._sources.setdefault(own, name)
        if own in self._readers and other != name:
            raise InputError(
                f'the bag holds two cells ({other}, {name}); record each into a bag of its own'
            )
        return TrafficLog(), self._readers.get(own)

    def _sorted(self, topic: GraphTopic) -> list[Record]:
        """The messages of a rare topic by log time."""
        return sorted(self._rare[topic.short_name], key=lambda record: record.log_ns)

    def _within(self, topic: GraphTopic, start: Start) -> list[Record]:
        """The messages of a rare topic that belong to a start."""
        return [each for each in self._sorted(topic) if start.begin <= each.log_ns < start.end]

    def _changes(self, start: Start) -> list[ParameterChange]:
        """Changes of parameters of this cell's nodes until the end of a start."""
        namespace = self._sources.get(STATE, STATE).removesuffix(STATE)
        events = self._sorted(interface.PARAMETER_EVENTS)
        until = parameter_changes(each for each in events if each.log_ns <= start.ran[1])
        return [each for each in until if each.node.rpartition('/')[0] + '/' == namespace]

    def _latest(self, topic: GraphTopic, start: Start) -> Any:
        """The message in effect at the end of a start; None without one."""
        messages = self._sorted(topic)
        before = [each for each in messages if each.log_ns <= start.ran[1]]
        chosen = before[-1:] or messages[:1]
        return chosen[0].message() if chosen else None

    def _states(self, columns: Columns) -> Floats:
        self._stop_reasons += columns['stop_reason'].tolist()
        self._model_ids += columns['model_id'].tolist()
        return ticks(columns)

    def _stop_reason(self, start: Start) -> str:
        """The first reason that the controller stated; empty without one.

        It keeps the first of a stop; after a release that no tick shows, another may follow.
        """
        order = self._tables[STATE].log_order[start.ticks]
        stated = [self._stop_reasons[row] for row in order.tolist()]
        return next((reason for reason in stated if reason), '')

    def _lessons(self, start: Start) -> Iterator[DrivenLesson]:
        """The lessons that drove a start, in the order of its ticks."""
        records = self._sorted(interface.LESSON)
        known = {each.lesson_id: each for each in (record.message() for record in records)}
        order, before = self._tables[STATE].log_order[start.ticks], ''
        stamps = self._state_rows.stamp[start.ticks]
        for row, stamp in zip(order.tolist(), stamps.tolist(), strict=True):
            driven = self._model_ids[row]
            if driven != before and driven in known:
                yield lesson(known[driven], stamp)
            before = driven

    def _reference(self, start: Start) -> Reference | None:
        plan = self._latest(interface.NOMINAL_TRAJECTORY, start)
        return None if plan is None else reference(plan)

    def _model(self, start: Start) -> ModelFacts | None:
        info = self._latest(interface.MODEL_INFO, start)
        return None if info is None else model(info)
