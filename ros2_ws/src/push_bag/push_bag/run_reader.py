"""Reads a bag into the time series that the score and the report work on."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from push_core.errors import InputError

from push_bag.cell_topics import short_name
from push_bag.conversions import (
    disturbance,
    model,
    nanoseconds,
    planar_pose,
    position,
    reference,
    tick,
    velocity,
)
from push_bag.reader import BagReader, Record
from push_bag.series import STATE_COLUMNS, Disturbance, Model, Reference, RunSeries, Stamped
from push_bag.traffic import Traffic


def read_run(path: Path) -> RunSeries:
    """Reads a bag from end to end, decoding only what the score needs.

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
    """Collects the rows of each series while the bag streams by."""

    def __init__(self) -> None:
        self.traffic: dict[str, Traffic] = {}
        self._rows: dict[str, list[tuple[int, int, tuple[float, ...]]]] = {}
        self._stop_reason = ''
        self._reference: Reference | None = None
        self._model: Model | None = None
        self._disturbances: list[Disturbance] = []
        self._readers: Mapping[str, Callable[[Record], None]] = {
            'object_pose': lambda record: self._add_row(record, planar_pose),
            'pusher_pose': lambda record: self._add_row(record, position),
            'pusher_velocity_cmd': lambda record: self._add_row(record, velocity),
            'controller_state': self._add_state,
            'nominal_trajectory': self._set_reference,
            'model_info': self._set_model,
            'perturbation': self._add_disturbance,
        }

    def add(self, record: Record) -> None:
        """Counts a record and keeps what the series need of it."""
        seen = self.traffic.setdefault(record.topic.name, Traffic())
        seen.saw(record.sequence, record.log_ns)
        read = self._readers.get(short_name(record.topic.name))
        if read is not None:
            read(record)

    def series(self, reader: BagReader) -> RunSeries:
        """All that was collected."""
        return RunSeries(
            facts=reader.facts,
            finished=reader.finished,
            traffic={name: self.traffic.get(name, Traffic()) for name in reader.topics},
            object=self._stamped('object_pose', 3),
            pusher=self._stamped('pusher_pose', 2),
            commands=self._stamped('pusher_velocity_cmd', 2),
            states=self._stamped('controller_state', len(STATE_COLUMNS)),
            stop_reason=self._stop_reason,
            reference=self._reference,
            model=self._model,
            disturbances=tuple(self._disturbances),
        )

    def _stamped(self, name: str, width: int) -> Stamped:
        rows = self._rows.get(name, [])
        stamp = np.array([row[0] for row in rows], np.int64)
        published = np.array([row[1] for row in rows], np.int64)
        values = np.array([row[2] for row in rows], np.float64).reshape(-1, width)
        _, first = np.unique(stamp, return_index=True)
        return Stamped(stamp[first], published[first], values[first])

    def _add_row(self, record: Record, values: Callable[[Any], tuple[float, ...]]) -> None:
        message = record.message()
        row = (nanoseconds(message), record.publish_ns, values(message))
        self._rows.setdefault(short_name(record.topic.name), []).append(row)

    def _add_state(self, record: Record) -> None:
        self._add_row(record, self._state_values)

    def _state_values(self, message: Any) -> tuple[float, ...]:
        self._stop_reason = message.stop_reason or self._stop_reason
        return tick(message)

    def _set_reference(self, record: Record) -> None:
        self._reference = reference(record.message())

    def _set_model(self, record: Record) -> None:
        self._model = model(record.message())

    def _add_disturbance(self, record: Record) -> None:
        self._disturbances.append(disturbance(record.message()))
