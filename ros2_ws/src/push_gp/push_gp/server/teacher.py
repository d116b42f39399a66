"""Lets laps teach what the next ones are driven with, without delaying the server's answers."""

from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor

from push_core.physics import Slider
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from push_gp.learn import LapLearner, Learned, MeasuredLap, TimedReference
from push_gp.server.lap_watch import LapWatch

POLL_PERIOD = 0.02  # [s]


class Teacher:
    """Learns in a thread from the laps of a cell.

    Attributes:
        laps: that have taught.
        known: what they have taught.
    """

    def __init__(
        self,
        node: Node,
        mode: str,
        slider: Slider,
        base: str,
        on_lesson: Callable[[], None],
        start: Learned | None = None,
    ) -> None:
        """Follows the cell of a node.

        Args:
            node: that listens.
            mode: of the cell, lockstep or realtime.
            slider: nominal one.
            base: id of the model that is served until a cone is identified.
            on_lesson: called in the node's thread after each lap.
            start: what laps before have taught.
        """
        self._learner = LapLearner(slider, base, start)
        self.known, self.laps = self._learner.known, 0
        self._on_lesson = on_lesson
        self._log = node.get_logger()
        self._worker = ThreadPoolExecutor(max_workers=1)
        self._work: deque[tuple[int, Future[Learned]]] = deque()
        self._watch = LapWatch(node, mode, self._begin, self._learn)
        node.create_timer(POLL_PERIOD, self._poll, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def close(self) -> None:
        """Ends the thread."""
        self._worker.shutdown(wait=False, cancel_futures=True)

    def _begin(self, reference: TimedReference) -> None:
        def begun() -> Learned:
            self._learner.begin(reference)
            return self._learner.known

        self._work.append((0, self._worker.submit(begun)))

    def _learn(self, lap: MeasuredLap | None) -> None:
        learn = self._learner.learn
        known = (lambda: self._learner.known) if lap is None else (lambda: learn(lap))
        self._work.append((1, self._worker.submit(known)))

    def _poll(self) -> None:
        """Tells of the lessons that are ready; after an error things stay as they are."""
        while self._work and self._work[0][1].done():
            laps, future = self._work.popleft()
            error, before = future.exception(), self.known
            if error is None:
                self.known = future.result()
            else:
                self._log.error(f'a lap taught nothing: {error!r}')
            self.laps += laps
            if laps or self.known is not before:
                self._on_lesson()
