"""Gets model and lessons from the server, as what the loop uses, without delaying the loop."""

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from push_core.common import PushError
from push_msgs.msg import Lesson as LessonMessage
from push_msgs.msg import ModelInfo
from push_msgs.srv import Predict
from push_node import interface
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.task import Future

from push_mpc.loop import PreparedModel
from push_mpc.node.conversions import lesson_of, request_of, result_of
from push_mpc.node.lap_gate import Taught
from push_mpc.plan import Lesson
from push_mpc.settings import MpcSettings
from push_mpc.table import Domain, ModelScope, Query, Table, Tabulated, Tabulation, tabulation

POLL_PERIOD = 0.02  # [s]
RETRY_AFTER = 1.0  # [s]; a request sent before discovery has finished is lost
Prepare = Callable[[Table, str, Lesson | None], PreparedModel]
"""Makes a model for the controller from a table, a model id, and what laps have taught."""


@dataclass
class _Pending:
    """An announced model whose table is being made.

    Attributes:
        info: the announcement.
        lesson: what it is driven with; None where nothing is learned.
        tabulation: generator of queries.
        query: the one to send or to send again, None while its result is being used.
        sent: when it was sent last, on the monotonic clock [s].
    """

    info: ModelInfo
    lesson: LessonMessage | None
    tabulation: Tabulation
    query: Query | None
    sent: float = -RETRY_AFTER


class ModelClient:
    """Tabulates each announced model and prepares it for the controller in a worker thread.

    The node's thread only sends requests and receives responses; the worker makes the table and
    everything that the controller derives from it. A node that learns takes a model only together
    with the lesson that names it.

    Attributes:
        ready: the newest prepared model, None before the first.
        table: its table, None before the first.
        problem: why there is no model, in words; empty if there is one.
    """

    def __init__(self, node: Node, settings: MpcSettings, prepare: Prepare) -> None:
        """Subscribes to announcements.

        Args:
            node: of the client.
            settings: of the node.
            prepare: makes a model for the controller.
        """
        self.ready: PreparedModel | None = None
        self.table: Tabulated | None = None
        self.problem = 'no model announced'
        self._settings, self._side = settings, settings.slider.side
        self._prepare = prepare
        self._worker = ThreadPoolExecutor(max_workers=1)
        self._pending: _Pending | None = None
        self._handled: _Pending | None = None
        self._lesson: LessonMessage | None = None
        self._info: ModelInfo | None = None
        self._log = node.get_logger()
        self._client = interface.PREDICT.client(node)
        interface.MODEL_INFO.subscription(node, self._on_model)
        if settings.learn:
            interface.LESSON.subscription(node, self._on_lesson)
        node.create_timer(POLL_PERIOD, self._send, clock=Clock(clock_type=ClockType.STEADY_TIME))

    @property
    def taught(self) -> Taught:
        """What has taught what is ready, or could not be used."""
        lesson = self._handled.lesson if self._handled else None
        return Taught(lesson.laps, lesson.pieces) if lesson else Taught()

    def close(self) -> None:
        """Ends the thread."""
        self._worker.shutdown(wait=False, cancel_futures=True)

    def _on_model(self, info: ModelInfo) -> None:
        self._info = info
        if self._settings.learn:
            self._match()
        else:
            self._begin(info, None)

    def _on_lesson(self, lesson: LessonMessage) -> None:
        self._lesson = lesson
        self._match()

    def _match(self) -> None:
        """Begins with the newest model and lesson, when they are of each other."""
        info, lesson = self._info, self._lesson
        if info is None or lesson is None or info.model_id != lesson.model_id:
            self.problem = self.problem if self.ready else 'waiting for a model and its lesson'
            return
        pending = self._pending
        if pending and pending.lesson and pending.lesson.lesson_id == lesson.lesson_id:
            # the same once more: it may count further laps and pieces
            pending.lesson = lesson
        else:
            self._begin(info, lesson)

    def _begin(self, info: ModelInfo, lesson: LessonMessage | None) -> None:
        self.problem = f'model {info.model_id} is announced, waiting for its predictions'
        data = Domain.of_data(tuple(info.p_y_domain), tuple(info.beta_domain), self._side)
        steps = tabulation(ModelScope(data, info.kind, info.mean_function, self._side))
        self._pending = _Pending(info, lesson, steps, next(steps))
        self._send()

    def _send(self) -> None:
        """Sends the pending query, again if no response comes."""
        pending = self._pending
        if pending is None or pending.query is None or not self._client.service_is_ready():
            return
        if time.monotonic() - pending.sent <= RETRY_AFTER:
            return
        pending.sent = time.monotonic()
        query = pending.query

        def on_response(future: Future) -> None:
            if self._pending is pending and pending.query is query:
                pending.query = None
                self._worker.submit(self._take, pending, query, future)

        self._client.call_async(request_of(query)).add_done_callback(on_response)

    def _take(self, pending: _Pending, query: Query, future: Future) -> None:
        """Runs in the worker, which does not report exceptions by itself."""
        try:
            self._continue(pending, query, future.result())
        except (PushError, ValueError) as error:
            self._fail(pending, str(error))
        except Exception as error:  # noqa: BLE001
            self._fail(pending, repr(error))

    def _fail(self, pending: _Pending, why: str) -> None:
        """Tells of a model that cannot be used; the one before stays."""
        self.problem = f'the model cannot be used: {why}'
        self._log.error(self.problem)
        if self.ready is not None and pending.lesson is not None:
            self._handled = pending

    def _continue(self, pending: _Pending, query: Query, response: Predict.Response) -> None:
        """Feeds a response to the tabulation; prepares the model when the table is done."""
        if not response.success:
            self.problem = f'the model server refused: {response.message}'
        elif response.model_id != pending.info.model_id:
            # the server has not taken the announced model over yet, or already has another
            pending.query = query
        else:
            try:
                query = pending.tabulation.send(result_of(response, pending.info.distance))
            except StopIteration as done:
                self._finish(pending, done.value)
            else:
                pending.sent = -RETRY_AFTER
                pending.query = query

    def _finish(self, pending: _Pending, tabulated: Tabulated) -> None:
        model_id, message = pending.info.model_id, pending.lesson
        lesson = None
        if message is not None:
            model_id, lesson = message.lesson_id, lesson_of(message, self._settings)
        prepared = self._prepare(tabulated.table, model_id, lesson)
        self.table, self.problem = tabulated, ''
        # these last: the node's thread polls them
        self.ready = prepared
        self._handled = pending
        self._log.info(f'model {model_id} as a table of {tabulated}')
