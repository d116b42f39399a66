"""Gets the model from the server, as a table, without holding up the loop."""

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from push_core.common import PushError
from push_msgs.msg import ModelInfo
from push_msgs.srv import Predict
from push_node.qos import LATCHED
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.task import Future

from push_mpc.loop import Model
from push_mpc.node.conversions import answer_of, request_of
from push_mpc.table import Conversation, Domain, Question, Subject, Table, Tabulated, tabulation

ASK_PERIOD = 0.02  # [s]
PATIENCE = 1.0  # [s]; a request sent before both sides know each other is lost


@dataclass
class _Wish:
    """A model that was announced, and how far the conversation about it has come."""

    info: ModelInfo
    conversation: Conversation
    question: Question | None
    asked: float = -PATIENCE


class ModelClient:
    """Tabulates each model that is announced, and prepares it for the controller in a thread.

    The node's own thread only sends a question and takes an answer; making tables of the answers,
    and of the tables what the controller needs, is the worker's.

    Attributes:
        ready: the newest prepared model, None before the first.
        table: what it was prepared from, None before the first.
        problem: why there is none, for a person; empty if there is one.
    """

    def __init__(self, node: Node, side: float, prepare: Callable[[Table, str], Model]) -> None:
        self.ready: Model | None = None
        self.table: Tabulated | None = None
        self.problem = 'no model announced'
        self._side = side
        self._prepare = prepare
        self._worker = ThreadPoolExecutor(max_workers=1)
        self._wish: _Wish | None = None
        self._log = node.get_logger()
        self._client = node.create_client(Predict, 'push_gp/predict')
        node.create_subscription(ModelInfo, 'model_info', self._on_model, LATCHED)
        node.create_timer(ASK_PERIOD, self._ask, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def close(self) -> None:
        """Ends the thread."""
        self._worker.shutdown(wait=False, cancel_futures=True)

    def _on_model(self, info: ModelInfo) -> None:
        self.problem = f'model {info.model_id} announced, its answers are under way'
        data = Domain.of_data(tuple(info.p_y_domain), tuple(info.beta_domain), self._side)
        conversation = tabulation(Subject(data, info.kind, info.mean_function, self._side))
        self._wish = _Wish(info, conversation, next(conversation))
        self._ask()

    def _ask(self) -> None:
        """Sends the question that waits, again if its answer does not come."""
        wish = self._wish
        if wish is None or wish.question is None or not self._client.service_is_ready():
            return
        if time.monotonic() - wish.asked <= PATIENCE:
            return
        wish.asked = time.monotonic()
        question = wish.question

        def on_answer(future: Future) -> None:
            if self._wish is wish and wish.question is question:
                wish.question = None
                self._worker.submit(self._take, wish, future)

        self._client.call_async(request_of(question)).add_done_callback(on_answer)

    def _take(self, wish: _Wish, future: Future) -> None:
        """In the worker, which would keep an error to itself."""
        try:
            self._go_on(wish, future.result())
        except (PushError, ValueError) as error:
            self.problem = f'the model cannot be used: {error}'
        except Exception as error:  # noqa: BLE001
            self.problem = f'the model cannot be used: {error!r}'

    def _go_on(self, wish: _Wish, answer: Predict.Response) -> None:
        """Goes on with the conversation, or ends it with a model."""
        if not answer.success:
            self.problem = f'the model server answered: {answer.message}'
        elif answer.model_id == wish.info.model_id:
            try:
                question = wish.conversation.send(answer_of(answer, wish.info.distance))
            except StopIteration as done:
                self._finish(wish.info.model_id, done.value)
            else:
                wish.asked = -PATIENCE
                wish.question = question

    def _finish(self, model_id: str, tabulated: Tabulated) -> None:
        prepared = self._prepare(tabulated.table, model_id)
        self.table, self.problem = tabulated, ''
        # last, for it is what the node's thread looks for
        self.ready = prepared
        self._log.info(f'model {model_id} as a table of {tabulated}')
