"""Reads a bag into the time series that score and report use."""

from collections.abc import Callable, Mapping
from pathlib import Path

from push_core.common import InputError
from push_node import interface
from push_node.endpoints import GraphTopic, short_name

from push_bag.file import BagReader, Columns, Record, Traffic, TrafficLog, counted
from push_bag.run.conversions import (
    ORIENTED_POSE_FIELDS,
    POSE_FIELDS,
    STATE_FIELDS,
    TRUTH_FIELDS,
    TWIST_FIELDS,
    measured_poses,
    model,
    perturbation,
    positions,
    reference,
    ticks,
    true_poses,
    velocities,
)
from push_bag.run.series import (
    STATE_COLUMNS,
    Floats,
    ModelFacts,
    Reference,
    RunSeries,
)
from push_bag.run.topic_table import TopicTable

RARE = (
    interface.NOMINAL_TRAJECTORY.short_name,
    interface.MODEL_INFO.short_name,
    interface.PERTURBATION.short_name,
    interface.HORIZON.short_name,
    interface.RUN_END.short_name,
)
"""Topics that are read as messages."""


def read_run(path: Path) -> RunSeries:
    """Reads a whole bag; decodes only the fields that the score needs.

    Args:
        path: run folder or MCAP file.

    Raises:
        InputError: there is no bag, or it is not readable.
    """
    reader = BagReader(path)
    rows = _Rows()
    for record in reader.records():
        rows.add(record)
    if rows.is_empty:
        raise InputError(f'{reader.path} holds no messages')
    return rows.series(reader)


class _Rows:
    """Collects the rows of each series, record by record."""

    def __init__(self) -> None:
        self._tables = {
            interface.OBJECT_POSE.short_name: TopicTable(ORIENTED_POSE_FIELDS, 3, measured_poses),
            interface.PUSHER_POSE.short_name: TopicTable(POSE_FIELDS, 2, positions),
            interface.GROUND_TRUTH.short_name: TopicTable(TRUTH_FIELDS, 3, true_poses),
            interface.PUSHER_VELOCITY_CMD.short_name: TopicTable(TWIST_FIELDS, 2, velocities),
            interface.CONTROLLER_STATE.short_name: TopicTable(
                STATE_FIELDS, len(STATE_COLUMNS), self._states
            ),
        }
        self._rare: dict[str, list[Record]] = {name: [] for name in RARE}
        self._topics: dict[str, tuple[TrafficLog, Callable[[Record], None] | None]] = {}
        self._sources: dict[str, str] = {}
        self._stop_reasons: list[str] = []
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

    def series(self, reader: BagReader) -> RunSeries:
        """The series of all records.

        Raises:
            InputError: a message is not of its topic's type.
        """
        traffic = counted({name: log for name, (log, _) in self._topics.items()})
        for name, lost in reader.middleware_lost.items():
            traffic.setdefault(name, Traffic()).middleware_lost = lost
        tables = {name: table.stamped() for name, table in self._tables.items()}
        return RunSeries(
            facts=reader.facts,
            finished=reader.finished,
            traffic={name: traffic.get(name, Traffic()) for name in reader.topics},
            types={name: topic.type_name for name, topic in reader.topics.items()},
            object=tables[interface.OBJECT_POSE.short_name],
            truth=tables[interface.GROUND_TRUTH.short_name],
            pusher=tables[interface.PUSHER_POSE.short_name],
            commands=tables[interface.PUSHER_VELOCITY_CMD.short_name],
            states=tables[interface.CONTROLLER_STATE.short_name],
            # the cell also reports nodes that died
            stop_reason=self._end_reason() or self._stop_reason(),
            reference=self._reference(),
            model=self._model(),
            perturbations=tuple(
                perturbation(each.message()) for each in self._sorted(interface.PERTURBATION)
            ),
            horizons=tuple(self._sorted(interface.HORIZON)),
        )

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

    def _states(self, columns: Columns) -> Floats:
        self._stop_reasons += columns['stop_reason'].tolist()
        return ticks(columns)

    def _stop_reason(self) -> str:
        """The last reason that the controller stated; empty without one."""
        order = self._tables[interface.CONTROLLER_STATE.short_name].log_order
        stated = [self._stop_reasons[row] for row in order.tolist()]
        return next((reason for reason in reversed(stated) if reason), '')

    def _end_reason(self) -> str:
        ends = self._sorted(interface.RUN_END)
        return str(ends[-1].message().data) if ends else ''

    def _reference(self) -> Reference | None:
        plans = self._sorted(interface.NOMINAL_TRAJECTORY)
        return reference(plans[-1].message()) if plans else None

    def _model(self) -> ModelFacts | None:
        models = self._sorted(interface.MODEL_INFO)
        return model(models[-1].message()) if models else None
