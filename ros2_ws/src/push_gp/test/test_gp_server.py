"""The server as a process of its own, over real DDS."""

import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rclpy
from push_core.data.push_set import PushSet
from push_gp.models.gp_model import GpModel
from push_gp.models.model_file import load_model, save_model
from push_gp.server.conversions import pushes_of
from push_msgs.msg import AddedPushes, ModelInfo
from push_msgs.srv import AddPushes, GetModel, Predict
from push_node.ask import ask
from push_node.qos import HISTORY, LATCHED
from rclpy.experimental import EventsExecutor

pytestmark = pytest.mark.processes

PATIENCE = 60.0  # [s]; nothing but a hang takes that long


class Client:
    """Calls the server and keeps what it announces."""

    def __init__(self) -> None:
        self.node = rclpy.create_node('client')
        self.executor = EventsExecutor()
        self.executor.add_node(self.node)
        self.announced: list[ModelInfo] = []
        self.node.create_subscription(ModelInfo, 'model_info', self.announced.append, LATCHED)
        self.added: list[AddedPushes] = []
        self.node.create_subscription(AddedPushes, 'added_pushes', self.added.append, HISTORY)
        self.predictor = self.node.create_client(Predict, 'push_gp/predict')
        self.adder = self.node.create_client(AddPushes, 'push_gp/add_pushes')

    def wait_until(self, condition: Callable[[], bool]) -> None:
        assert self.happens(condition, PATIENCE), 'the server did not answer'

    def happens(self, condition: Callable[[], bool], timeout: float) -> bool:
        end = time.monotonic() + timeout
        while not condition() and time.monotonic() < end:
            self.executor.spin_once(timeout_sec=0.1)
        return condition()

    def predict(self, p_y: Any, beta: Any, *, want_variance: bool = False) -> Predict.Response:
        request = Predict.Request(p_y=p_y, beta=beta, want_variance=want_variance)
        return self.answer(self.predictor, request)

    def add(self, pushes: PushSet, **changes: Any) -> AddPushes.Response:
        request = AddPushes.Request(
            p_y=pushes.p_y,
            beta=pushes.beta,
            displacement=pushes.displacement.ravel(),
            distance=pushes.distance,
        )
        for name, value in changes.items():
            setattr(request, name, value)
        return self.answer(self.adder, request)

    def answer(self, client: Any, request: Any) -> Any:
        answer = ask(client, request, self.happens)
        assert answer is not None, f'{client.srv_name} did not answer'
        return answer


def started(*parameters: str) -> subprocess.Popen[str]:
    options = [option for parameter in parameters for option in ('-p', parameter)]
    return subprocess.Popen(
        [sys.executable, '-m', 'push_gp.server.gp_server', '--ros-args', *options],
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.fixture(scope='module')
def client() -> Iterator[Client]:
    rclpy.init()
    client = Client()
    yield client
    client.executor.remove_node(client.node)
    client.node.destroy_node()
    rclpy.shutdown()


@pytest.fixture(scope='module')
def server(
    client: Client, model: GpModel, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[subprocess.Popen[str]]:
    path = tmp_path_factory.mktemp('model') / 'model.npz'
    save_model(path, model)
    process = started(f'model:={path}')
    client.wait_until(lambda: bool(client.announced))
    yield process
    process.terminate()
    assert process.wait(PATIENCE) == 0


@pytest.mark.usefixtures('server')
class TestServer:
    def test_it_announces_its_model_to_who_comes_late(
        self, client: Client, model: GpModel
    ) -> None:
        announced = client.announced[0]
        assert announced.model_hash == model.info.model_hash
        assert announced.kind == 'gp'
        assert announced.points == 60
        assert announced.distance == 0.004
        assert np.array_equal(announced.lengthscales, model.info.lengthscales.ravel())

    def test_it_answers_with_the_very_numbers_of_the_model(
        self, client: Client, model: GpModel, queries: tuple[np.ndarray, np.ndarray]
    ) -> None:
        answer = client.predict(*queries, want_variance=True)
        mean, jacobian = model.evaluate(*queries)
        assert answer.success
        assert answer.model_id == model.info.model_id
        assert np.array_equal(np.reshape(answer.mean, (40, 3)), mean)
        assert np.array_equal(np.reshape(answer.jacobian, (40, 3, 2)), jacobian)
        assert np.array_equal(np.reshape(answer.variance, (40, 3)), model.variance(*queries))

    def test_it_hands_out_the_file_that_it_loaded(
        self, client: Client, model: GpModel, tmp_path: Path
    ) -> None:
        answer = client.answer(
            client.node.create_client(GetModel, 'push_gp/get_model'), GetModel.Request()
        )
        assert (answer.success, answer.name) == (True, 'model.npz')
        (tmp_path / 'copy.npz').write_bytes(bytes(answer.content))
        assert load_model(tmp_path / 'copy.npz').info.model_hash == model.info.model_hash

    def test_it_answers_for_none_and_for_many(self, client: Client) -> None:
        assert client.predict([], []).success
        many = client.predict(np.zeros(5000), np.full(5000, 1.5))
        assert len(many.jacobian) == 30_000
        assert len(many.variance) == 0

    def test_it_refuses_bad_requests_and_lives_on(
        self, client: Client, more_pushes: PushSet
    ) -> None:
        refusals = [
            client.predict([0.0], []),
            client.predict([np.nan], [1.0]),
            client.predict([np.inf], [1.0]),
            client.predict([0.2], [1.0]),
            client.predict([0.0], [3.2]),
            client.add(more_pushes, beta=[1.0]),
            client.add(more_pushes, displacement=[0.0]),
            client.add(more_pushes, distance=0.01),
            client.add(more_pushes, distance=np.nan),
            client.add(more_pushes, p_y=[], beta=[], displacement=[]),
        ]
        for refusal in refusals:
            assert not refusal.success
            assert refusal.message
        assert client.predict([0.0], [1.0]).success

    def test_it_outlives_a_client_that_dies_in_the_middle_of_a_call(self, client: Client) -> None:
        code = (
            'import os, rclpy; from push_msgs.srv import Predict; rclpy.init();'
            'node = rclpy.create_node("dying");'
            'client = node.create_client(Predict, "push_gp/predict");'
            'assert client.wait_for_service(60.0);'
            'client.call_async(Predict.Request(p_y=[0.0] * 20000, beta=[1.5] * 20000));'
            'os._exit(0)'
        )
        subprocess.run([sys.executable, '-c', code], check=True, timeout=2 * PATIENCE)
        assert client.predict([0.0], [1.0]).success

    def test_it_takes_new_pushes_in_and_announces_the_new_model(
        self, client: Client, model: GpModel, more_pushes: PushSet
    ) -> None:
        before = len(client.announced)
        answer = client.add(more_pushes)
        assert answer.success
        assert answer.points == 72
        client.wait_until(lambda: len(client.announced) > before)
        assert client.announced[-1].model_id == answer.model_id
        assert client.announced[-1].model_hash == model.extended(more_pushes).info.model_hash
        assert client.predict([0.0], [1.0]).model_id == answer.model_id
        client.wait_until(lambda: bool(client.added))
        assert client.added[-1].model_id == answer.model_id
        assert pushes_of(client.added[-1]).sha256() == more_pushes.sha256()


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_with_status_0(client: Client, number: int) -> None:
    before = len(client.announced)
    process = started('model:=analytical', 'slider.friction_pusher:=0.2')
    client.wait_until(lambda: len(client.announced) > before)
    assert client.announced[-1].kind == 'analytical'
    process.send_signal(number)
    assert process.wait(PATIENCE) == 0


@pytest.mark.parametrize(
    ('parameter', 'fault'),
    [
        ('model:=none.npz', 'No such file'),
        ('speed:=3.0', "unknown parameter 'speed'"),
    ],
)
def test_a_wrong_parameter_is_one_line_and_status_2(parameter: str, fault: str) -> None:
    _, shown = (process := started(parameter)).communicate(timeout=PATIENCE)
    assert process.returncode == 2
    assert fault in shown
    assert shown.count('\n') == 1
