"""Runs the node graph once: reset, start, watch."""

import math
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

import rclpy
from push_core.common import RunError
from push_mpc.loop import Mode
from push_msgs.msg import ControllerState, Lesson, NominalTrajectory
from push_node import interface
from push_node.ask import READY_TIMEOUT
from push_node.spin import Spinner, stop_on_signals
from push_node.start_ros import init_ros
from rclpy.node import Node
from std_msgs.msg import String
from tqdm import tqdm

from push_bringup.graph.neighbours import check_alone, check_single, rivals
from push_bringup.graph.processes import Processes
from push_bringup.graph.starter import Starter

STALL_TIMEOUT = 10.0  # [s] without a tick
LEARN_TIMEOUT = 60.0  # [s] for which the plant may wait for what a lap teaches
_ENDS = (Mode.DONE, Mode.STOPPED, Mode.FAULT)


class Conductor:
    """A node that calls the services of the cell and listens to its controller."""

    def __init__(
        self,
        namespace: str,
        processes: Processes,
        *,
        alone: bool = True,
        watch: bool = False,
        lessons: int = 0,
    ) -> None:
        """Joins the graph.

        Args:
            namespace: of the cell, '' for none.
            processes: the nodes.
            alone: whether they are still to be started, so that no other may be there.
            watch: whether to show a view of the cell instead of a progress bar.
            lessons: laps that teach; the run ends when the last one has.
        """
        stop_on_signals()
        init_ros()
        self._node = Node('cell', namespace=namespace)
        self._processes, self._alone = processes, alone
        self._spinner = Spinner(self._node)
        self._plan: NominalTrajectory | None = None
        self._state: ControllerState | None = None
        self._last_tick = 0.0
        self._lessons, self._taught = lessons, 0
        self._patience = LEARN_TIMEOUT if lessons else STALL_TIMEOUT
        if lessons:
            interface.LESSON.subscription(self._node, self._on_lesson)
        interface.NOMINAL_TRAJECTORY.subscription(self._node, self._on_plan)
        interface.CONTROLLER_STATE.subscription(self._node, self._on_state)
        self._end = interface.RUN_END.publisher(self._node)
        self._view = watch_view(self._node) if watch else None
        self._starter = Starter(self._node, self._wait_for)

    def close(self) -> None:
        """Leaves the graph."""
        self._spinner.close()
        self._node.destroy_node()
        rclpy.try_shutdown()

    def run(self) -> str:
        """One run.

        Returns:
            Reason of an early end, else an empty string; it is also published for the recorder.

        Raises:
            KeyboardInterrupt: a stop was requested.
        """
        try:
            reason = self._run()
        except RunError as error:
            reason = str(error)
        if reason:
            # found late on a busy machine, they explain whatever went wrong
            reason = rivals(self._node) or reason
        self._end.publish(String(data=reason))
        return reason

    def _run(self) -> str:
        """Reason of an early stop of the controller, else an empty string.

        Raises:
            RunError: another cell runs here, this one did not become ready, or a node ended.
            KeyboardInterrupt: a stop was requested.
        """
        if self._alone:
            check_alone(self._node)
            self._processes.start()
        self._wait(lambda: self._plan is not None, READY_TIMEOUT, 'no plan from mpc_node')
        check_single(self._node)
        self._starter.start()
        return self._watch()

    def _watch(self) -> str:
        assert self._plan is not None
        self._state, self._last_tick = None, time.monotonic()
        with self._view or progress_bar() as show:
            while not self._ended():
                self._spin_once()
                if time.monotonic() - self._last_tick > self._patience:
                    raise RunError(f'no tick of mpc_node for {self._patience:g} s')
                show(self._state, self._plan)
        reason = str(self._state.stop_reason) if self._state else ''
        if not reason:
            taught = 'the last lap taught nothing'
            self._wait(lambda: self._taught >= self._lessons, LEARN_TIMEOUT, taught)
        return reason

    def _ended(self) -> bool:
        return self._state is not None and self._state.mode in _ENDS

    def _on_plan(self, message: NominalTrajectory) -> None:
        self._plan = message

    def _on_lesson(self, message: Lesson) -> None:
        self._taught = message.laps

    def _on_state(self, message: ControllerState) -> None:
        self._state = message
        self._last_tick = time.monotonic()

    def _wait(self, finished: Callable[[], bool], timeout: float, complaint: str) -> None:
        if not self._wait_for(finished, timeout):
            raise RunError(f'{complaint} within {timeout:g} s')

    def _wait_for(self, finished: Callable[[], bool], timeout: float) -> bool:
        deadline = time.monotonic() + timeout
        while not finished() and time.monotonic() < deadline:
            self._spin_once()
        return finished()

    def _spin_once(self) -> None:
        """Handles one event, or waits a moment for one."""
        self._processes.check()
        if not self._spinner.once():
            raise KeyboardInterrupt


Show = Callable[[ControllerState | None, NominalTrajectory], None]


@contextmanager
def progress_bar() -> Iterator[Show]:
    """A bar of the time of the reference, silent where nobody looks."""
    with tqdm(unit='s', desc='pushing', disable=None) as bar:

        def show(state: ControllerState | None, plan: NominalTrajectory) -> None:
            bar.total = round(plan.time[-1], 2)
            if state is not None and math.isfinite(state.reference_time):
                bar.update(min(max(state.reference_time, bar.n), bar.total) - bar.n)

        yield show


def watch_view(node: Node) -> AbstractContextManager[Show]:
    """The view of `cell --watch`; its library is imported only then."""
    from push_bringup.graph.watch_view import WatchView  # noqa: PLC0415

    return WatchView(node)
