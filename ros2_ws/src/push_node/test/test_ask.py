from collections.abc import Callable

from push_node.ask import ATTEMPTS, ask
from rclpy.task import Future


class LosingClient:
    """A client whose service throws the first answers away."""

    def __init__(self, lost: int, ready: bool = True) -> None:
        self.asked = 0
        self._lost, self._ready = lost, ready

    def service_is_ready(self) -> bool:
        return self._ready

    def call_async(self, request: str) -> Future:
        self.asked += 1
        future = Future()
        if self.asked > self._lost:
            future.set_result(f'{request}, {self.asked}')
        return future


def at_once(finished: Callable[[], bool], _timeout: float) -> bool:
    return finished()


def test_it_asks_again_until_an_answer_comes() -> None:
    assert ask(LosingClient(lost=0), 'hello', at_once) == 'hello, 1'
    assert ask(LosingClient(lost=3), 'hello', at_once) == 'hello, 4'


def test_it_gives_up() -> None:
    client = LosingClient(lost=100)
    assert ask(client, 'hello', at_once) is None
    assert client.asked == ATTEMPTS


def test_it_does_not_ask_where_there_is_no_service() -> None:
    client = LosingClient(lost=0, ready=False)
    assert ask(client, 'hello', at_once) is None
    assert client.asked == 0
