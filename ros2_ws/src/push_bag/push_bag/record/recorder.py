"""The recorder node: writes every topic of the cell to one bag."""

import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from push_core.common import InputError, RunError, flatten
from push_node.diagnostics import ERROR, UNPUBLISHED, WARN, Reporter, worst
from push_node.graph import full_name
from push_node.interface import TOPICS
from push_node.parameters import declared
from push_node.qos import is_latched
from push_node.spin import request_stop, run_node
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from push_bag.file import BagWriter, lost_text
from push_bag.record.cell_inputs import PARAMS_FILE, CellInputs
from push_bag.record.recorder_settings import (
    RecorderSettings,
    read_attachments,
    read_facts,
    split_list,
)
from push_bag.record.recording import Recording

DISCOVERY_PERIOD = 0.1  # [s] until all core topics of the cell are recorded
LATER_DISCOVERY_PERIOD = 1.0  # [s] afterwards
REPORT_PERIOD = 0.5  # [s]; mpc_node stops after 2 s without a report


class Recorder(Node):  # type: ignore[misc]
    """Records every topic of a cell to a new folder until it is stopped.

      ros2 run push_bag recorder --ros-args -p folder:=runs/NEW
      ros2 run push_bag recorder --ros-args -p folder:=runs/NEW -p topics:="/arm/*,/joint_states"

    folder        new folder of the run; must not exist yet
    topics        more topics to record: names or patterns, separated by commas
    attachments   files to attach to the bag, one per line
    facts_file    JSON object with the facts of the run

    Without a params.yaml among the attachments it asks the nodes of its namespace for their
    parameters and the model file, and attaches these, so that the run can be recomputed.
    """

    def __init__(self) -> None:
        super().__init__('recorder', automatically_declare_parameters_from_overrides=True)
        settings = declared(self, RecorderSettings())
        offers = {self.resolve_topic_name(topic.name): topic.qos for topic in TOPICS}
        others = {full_name(self, name) for name in split_list(settings.topics)}
        core = {self.resolve_topic_name(topic.name): topic for topic in TOPICS if topic.core}
        self._core = core.keys()
        self._passing = {name for name, topic in core.items() if not is_latched(topic.qos)}
        self._writer = open_bag(settings)
        self._recording = Recording(self, self._writer, {*offers, *others}, offers)
        self._inputs = self._unattached_inputs(settings)
        self._reporter = Reporter(self, 'recording')
        self._was_complete, self._lost_warn = False, settings.lost_warn
        self._failure: RunError | None = None
        self._start_timers(settings)

    def destroy_node(self) -> None:
        """Finishes the bag and writes the number of lost messages to standard error.

        Raises:
            RunError: the bag could not be written.
        """
        try:
            self._recording.close()
        finally:
            lost = lost_text(self._recording.traffic)
            sys.stderr.write(f'recorder: {lost}; {self._writer.path}\n')
            super().destroy_node()
        if self._failure is not None:
            raise self._failure

    def _unattached_inputs(self, settings: RecorderSettings) -> CellInputs | None:
        """What to fetch from the nodes; None where their parameters are attached already."""
        attached = {Path(path).name for path in settings.attachments.splitlines()}
        if PARAMS_FILE in attached:
            return None
        own = {name: value for name, (value, _) in flatten(settings).items()}
        return CellInputs(self, self._writer, own)

    def _start_timers(self, settings: RecorderSettings) -> None:
        # steady, because simulated time may stand still
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        drain = self._guarded(self._recording.drain)
        flush = self._guarded(self._recording.flush)
        self.create_timer(settings.poll_period, drain, clock=steady)
        self.create_timer(settings.flush_period, flush, clock=steady)
        self._discovery = self.create_timer(
            DISCOVERY_PERIOD, self._guarded(self._discover), clock=steady
        )
        self.create_timer(REPORT_PERIOD, self._report, clock=steady)

    def _guarded(self, work: Callable[[], None]) -> Callable[[], None]:
        """Wraps `work` so that its RunError is reported and ends the node."""

        def guarded() -> None:
            if self._failure is not None:
                return
            try:
                work()
            except RunError as error:
                self._failure = error
                self._report()
                request_stop()

        return guarded

    def _discover(self) -> None:
        refused = set(self._recording.refused)
        self._recording.discover()
        if self._inputs is not None:
            self._inputs.poll()
        for topic in self._recording.refused.keys() - refused:
            self.get_logger().warning(f'{topic}: {self._recording.refused[topic]}')
        if not self._was_complete and not self._missing() and not self._awaited():
            self._was_complete = True
            self._discovery.timer_period_ns = round(LATER_DISCOVERY_PERIOD * 1e9)
            self._report()

    def _report(self) -> None:
        if self._failure is not None:
            self._reporter.report(ERROR, str(self._failure), self._counts())
            return
        missing = ', '.join(sorted(self._missing()))
        awaited = ', '.join(sorted(self._awaited()))
        gone = ', '.join(sorted(self._passing & self._recording.unpublished()))
        lost = sum(seen.lost for seen in self._recording.traffic.values())
        findings = [
            (ERROR, f'no publisher of {missing}' if missing else ''),
            (ERROR, f'parameters of {awaited} not yet read' if awaited else ''),
            (WARN, f'no publisher of {gone} any more' if gone else ''),
            (WARN, f'{lost} messages lost' if lost >= self._lost_warn else ''),
        ]
        values = {UNPUBLISHED: gone, **self._counts()}
        self._reporter.report(*worst(findings, 'recording'), values)

    def _missing(self) -> set[str]:
        return self._core - self._recording.traffic.keys()

    def _awaited(self) -> set[str]:
        """Nodes whose parameters a run has to wait for."""
        if self._was_complete or self._inputs is None:
            return set()
        return self._inputs.awaited

    def _counts(self) -> dict[str, str]:
        return {
            topic: f'{seen.received} received, {seen.lost} lost, '
            f'{seen.middleware_lost or 0} reported by the middleware'
            for topic, seen in self._recording.traffic.items()
        }


def open_bag(settings: RecorderSettings) -> BagWriter:
    """Creates the bag, with facts and attachments.

    Raises:
        InputError: no folder was named, it exists, or a file to include cannot be read.
        RunError: the bag cannot be written.
    """
    if not settings.folder:
        raise InputError('name the new folder of the run with -p folder:=PATH')
    facts = read_facts(settings.facts_file)
    attachments = read_attachments(settings.attachments.splitlines())
    return BagWriter(Path(settings.folder), facts, attachments)


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the recorder until SIGINT or SIGTERM."""
    return run_node(Recorder, argv)


if __name__ == '__main__':
    sys.exit(main())
