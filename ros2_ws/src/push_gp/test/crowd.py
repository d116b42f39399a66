"""Clients of the model server, each in a process of its own, that ask all at once; one dies.

Standard input: a JSON list of questions, one for each client, each [p_y, beta]. The first client
is killed while its question is with the server; the others ask theirs several times meanwhile.
Standard output: a JSON list of the means that each of the others was answered, (clients - 1,
ROUNDS, 3 n).
"""

import json
import multiprocessing
import os
import sys
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

import rclpy
from push_msgs.srv import Predict
from push_node.ask import ask
from rclpy.experimental import EventsExecutor

ROUNDS = 5
HEARD = 0.3
"""How long [s] to wait for a first answer before asking once more."""
LONG = 2000
"""How many times over the client that dies asks its question, so that it dies in mid-call."""


class Asker:
    """A client that the server has answered once, so that they know of each other."""

    def __init__(self) -> None:
        rclpy.init()
        node = rclpy.create_node(f'client_{os.getpid()}')
        self.predictor = node.create_client(Predict, 'push_gp/predict')
        self._executor = EventsExecutor()
        self._executor.add_node(node)
        asked = [self.predictor.call_async(Predict.Request())]
        while not self._happens(lambda: any(each.done() for each in asked), HEARD):
            asked.append(self.predictor.call_async(Predict.Request()))

    def answer(self, request: Predict.Request) -> Any:
        found = ask(self.predictor, request, self._happens)
        assert found is not None, 'the server does not answer'
        return found

    def _happens(self, condition: Callable[[], bool], timeout: float) -> bool:
        end = time.monotonic() + timeout
        while not condition() and time.monotonic() < end:
            self._executor.spin_once(timeout_sec=0.1)
        return condition()


def client(parent: Connection) -> None:
    """Asks when it is told to, and hands the means over."""
    asker = Asker()
    parent.send('ready')
    p_y, beta = parent.recv()
    request = Predict.Request(p_y=p_y, beta=beta)
    parent.send([asker.answer(request).mean.tolist() for _ in range(ROUNDS)])


def dying_client(parent: Connection) -> None:
    """Asks much when it is told to, and waits for its end."""
    asker = Asker()
    parent.send('ready')
    p_y, beta = parent.recv()
    asker.predictor.call_async(Predict.Request(p_y=p_y * LONG, beta=beta * LONG))
    parent.send('asked')
    parent.recv()


def main() -> None:
    """Starts all, lets them ask, kills the first."""
    questions = json.load(sys.stdin)
    forks = multiprocessing.get_context('fork')
    ends = [forks.Pipe() for _ in questions]
    works = [dying_client] + [client] * (len(questions) - 1)
    processes = [
        forks.Process(target=work, args=(theirs,), daemon=True)
        for work, (_, theirs) in zip(works, ends, strict=True)
    ]
    for process in processes:
        process.start()
    first, *others = [ours for ours, _ in ends]
    assert {ours.recv() for ours in (first, *others)} == {'ready'}
    for ours, question in zip((first, *others), questions, strict=True):
        ours.send(question)
    assert first.recv() == 'asked'
    processes[0].kill()
    json.dump([ours.recv() for ours in others], sys.stdout)


if __name__ == '__main__':
    main()
