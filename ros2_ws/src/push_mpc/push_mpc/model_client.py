"""Gets the model from the server, as a table, without holding up the loop."""

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from push_core.errors import PushError
from push_msgs.msg import ModelInfo
from push_msgs.srv import Predict
from push_node.qos import LATCHED
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.task import Future

from push_mpc.controller import Model
from push_mpc.conversions import answer_arrays
from push_mpc.surrogate import Grid, Table

ASK_PERIOD = 0.1  # [s]
PATIENCE = 1.0  # [s]; a request sent before both sides know each other is lost
P_Y_POINTS = 37
BETA_POINTS = 61


class ModelClient:
    """Asks for a grid of answers whenever a model is announced and prepares it in a thread.

    Attributes:
        ready: the newest prepared model, None before the first.
        problem: why there is none, for a person; empty if there is one.
    """

    def __init__(self, node: Node, side: float, prepare: Callable[[Table, str], Model]) -> None:
        self.ready: Model | None = None
        self.problem = 'no model announced'
        self._side = side
        self._prepare = prepare
        self._worker = ThreadPoolExecutor(max_workers=1)
        self._wanted: ModelInfo | None = None
        self._asked = -PATIENCE
        self._client = node.create_client(Predict, 'push_gp/predict')
        node.create_subscription(ModelInfo, 'model_info', self._on_model, LATCHED)
        node.create_timer(ASK_PERIOD, self._ask, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def close(self) -> None:
        """Ends the thread."""
        self._worker.shutdown(wait=False, cancel_futures=True)

    def _on_model(self, info: ModelInfo) -> None:
        self.problem = f'model {info.model_id} announced, its answers are under way'
        self._wanted = info
        self._asked = -PATIENCE
        self._ask()

    def _ask(self) -> None:
        """Asks for the wanted model's answers, again if they do not come."""
        info = self._wanted
        overdue = time.monotonic() - self._asked > PATIENCE
        if info is None or not overdue or not self._client.service_is_ready():
            return
        self._asked = time.monotonic()
        grid, distance = model_grid(info, self._side), info.distance
        p_y, beta = grid.points()
        request = Predict.Request(p_y=p_y.tolist(), beta=beta.tolist(), want_variance=False)

        def on_answer(future: Future) -> None:
            if self._wanted is info:
                self._wanted = None
                self._worker.submit(self._take, future, grid, distance)

        self._client.call_async(request).add_done_callback(on_answer)

    def _take(self, future: Future, grid: Grid, distance: float) -> None:
        try:
            answer = future.result()
            if not answer.success:
                self.problem = f'the model server answered: {answer.message}'
                return
            table = Table(grid, *answer_arrays(answer, distance))
            self.ready = self._prepare(table, answer.model_id)
            self.problem = ''
        except (PushError, ValueError) as error:
            self.problem = f'the model cannot be used: {error}'


def model_grid(info: ModelInfo, side: float) -> Grid:
    """Where a model is asked: over its training data, but not off the face."""
    half = 0.5 * side
    low, high = np.clip(info.p_y_domain, -half, half)
    beta_low, beta_high = info.beta_domain
    return Grid(np.linspace(low, high, P_Y_POINTS), np.linspace(beta_low, beta_high, BETA_POINTS))
