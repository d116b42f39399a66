"""Lets laps and pieces of them teach what is driven next, beside the server's answers."""

from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor

from push_core.physics import Slider
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from push_gp.learn import LapLearner, Learned, MeasuredLap, TimedReference
from push_gp.server.lap_watch import LapWatch

POLL_PERIOD = 0.02  # [s]
_Counts = tuple[int, int]


class Teacher:
    """Learns in a thread from the laps of a cell.

    Attributes:
        taught: number of laps and of pieces that have.
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
            on_lesson: called in the node's thread after each lap, and when a piece of one taught
                something, in lockstep after each piece.
            start: what laps before have taught.
        """
        self._learner = LapLearner(slider, base, start)
        self.known, self.taught = self._learner.known, (0, 0)
        self._on_lesson = on_lesson
        self._log = node.get_logger()
        self._worker = ThreadPoolExecutor(max_workers=1)
        self._work: deque[tuple[_Counts, Future[Learned]]] = deque()
        self._patient = mode == 'lockstep'
        self._watch = LapWatch(node, mode, self._begin, self._refine, self._learn)
        node.create_timer(POLL_PERIOD, self._poll, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def close(self) -> None:
        """Ends the thread."""
        self._worker.shutdown(wait=False, cancel_futures=True)

    def _begin(self, reference: TimedReference) -> None:
        def begun() -> Learned:
            self._learner.begin(reference)
            return self._learner.known

        self._work.append(((0, 0), self._worker.submit(begun)))

    def _refine(self, piece: MeasuredLap) -> None:
        self._work.append(((0, 1), self._worker.submit(self._learner.refine, piece)))

    def _learn(self, lap: MeasuredLap | None) -> None:
        learn = self._learner.learn
        known = (lambda: self._learner.known) if lap is None else (lambda: learn(lap))
        self._work.append(((1, 0), self._worker.submit(known)))

    def _poll(self) -> None:
        """Tells of the lessons that are ready; after an error things stay as they are."""
        while self._work and self._work[0][1].done():
            (laps, pieces), future = self._work.popleft()
            error, before = future.exception(), self.known
            if error is None:
                self.known = future.result()
            else:
                self._log.error(f'a lap or a piece of one taught nothing: {error!r}')
            self.taught = self.taught[0] + laps, self.taught[1] + pieces
            # only in lockstep the controller waits for pieces that taught nothing
            if laps or (pieces and self._patient) or self.known is not before:
                self._on_lesson()
