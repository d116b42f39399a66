"""Reads a bag into the time series that score and report use."""

from collections.abc import Callable, Mapping
from pathlib import Path

from push_core.common import InputError
from push_node import interface
from push_node.endpoints import short_name

from push_bag.file import BagReader, Columns, Record, Traffic
from push_bag.run.conversions import (
    POSE_FIELDS,
    STATE_FIELDS,
    TRUTH_FIELDS,
    TWIST_FIELDS,
    model,
    perturbation,
    planar_poses,
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
    PerturbationEvent,
    Reference,
    RunSeries,
)
from push_bag.run.topic_table import TopicTable


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
    if not rows.traffic:
        raise InputError(f'{reader.path} holds no messages')
    return rows.series(reader)


class _Rows:
    """Collects the rows of each series, record by record."""

    def __init__(self) -> None:
        self.traffic: dict[str, Traffic] = {}
        self._tables = {
            interface.OBJECT_POSE.short_name: TopicTable(POSE_FIELDS, 3, planar_poses),
            interface.PUSHER_POSE.short_name: TopicTable(POSE_FIELDS, 2, positions),
            interface.GROUND_TRUTH.short_name: TopicTable(TRUTH_FIELDS, 3, true_poses),
            interface.PUSHER_VELOCITY_CMD.short_name: TopicTable(TWIST_FIELDS, 2, velocities),
            interface.CONTROLLER_STATE.short_name: TopicTable(
                STATE_FIELDS, len(STATE_COLUMNS), self._states
            ),
        }
        self._topics: dict[str, tuple[Traffic, Callable[[Record], None] | None]] = {}
        self._sources: dict[str, str] = {}
        self._stop_reason = self._end_reason = ''
        self._reference: Reference | None = None
        self._model: ModelFacts | None = None
        self._perturbations: list[PerturbationEvent] = []
        self._horizons: list[Record] = []
        self._readers: Mapping[str, Callable[[Record], None]] = {
            **{name: table.add for name, table in self._tables.items()},
            interface.NOMINAL_TRAJECTORY.short_name: self._set_reference,
            interface.MODEL_INFO.short_name: self._set_model,
            interface.PERTURBATION.short_name: self._add_perturbation,
            interface.HORIZON.short_name: self._horizons.append,
            interface.RUN_END.short_name: self._set_end_reason,
        }

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
        for name, lost in reader.contents.middleware_lost.items():
            self.traffic.setdefault(name, Traffic()).middleware_lost = lost
        tables = {name: table.stamped() for name, table in self._tables.items()}
        return RunSeries(
            facts=reader.facts,
            finished=reader.finished,
            traffic={name: self.traffic.get(name, Traffic()) for name in reader.topics},
            object=tables[interface.OBJECT_POSE.short_name],
            truth=tables[interface.GROUND_TRUTH.short_name],
            pusher=tables[interface.PUSHER_POSE.short_name],
            commands=tables[interface.PUSHER_VELOCITY_CMD.short_name],
            states=tables[interface.CONTROLLER_STATE.short_name],
            # the cell also reports nodes that died
            stop_reason=self._end_reason or self._stop_reason,
            reference=self._reference,
            model=self._model,
            perturbations=tuple(self._perturbations),
            horizons=tuple(self._horizons),
        )

    def _new_topic(self, name: str) -> tuple[Traffic, Callable[[Record], None] | None]:
        seen = self.traffic[name] = Traffic()
        own = short_name(name)
        other = self._sources.setdefault(own, name)
        if own in self._readers and other != name:
            raise InputError(
                f'the bag holds two cells ({other}, {name}); record each into a bag of its own'
            )
        return seen, self._readers.get(own)

    def _states(self, columns: Columns) -> Floats:
        reasons = [reason for reason in columns['stop_reason'] if reason]
        self._stop_reason = reasons[-1] if reasons else self._stop_reason
        return ticks(columns)

    def _set_reference(self, record: Record) -> None:
        self._reference = reference(record.message())

    def _set_end_reason(self, record: Record) -> None:
        self._end_reason = str(record.message().data)

    def _set_model(self, record: Record) -> None:
        self._model = model(record.message())

    def _add_perturbation(self, record: Record) -> None:
        self._perturbations.append(perturbation(record.message()))
