"""Shows recorded poses to a running controller and waits for its answers, as a simulator does.

The controller runs in lockstep: its clock is what this tells it, so that its answers do not depend
on how busy the machine is.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from geometry_msgs.msg import PoseStamped, TwistStamped
from push_core.common import RunError
from push_node import interface
from push_node.ask import READY_TIMEOUT, ask
from push_node.endpoints import GraphService
from push_node.spin import Spinner
from push_node.stamps import to_nanoseconds, to_stamp
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Trigger

from push_bag.run import Floats

PATIENCE = 0.2  # [s] for an answer, before the question is put again
ATTEMPTS = 50


@dataclass(frozen=True)
class TickInput:
    """What the controller knew at one tick.

    Attributes:
        stamp: of the poses [ns].
        now: when it was asked [ns].
        object_pose: as recorded.
        tip: as recorded.
    """

    stamp: int
    now: int
    object_pose: PoseStamped
    tip: PoseStamped


class NodeClient:
    """Stands in for the simulator of a controller."""

    def __init__(self, node: Node, prefix: str) -> None:
        """Looks for the controller.

        Args:
            node: that asks.
            prefix: of the names of the controller's topics and services.
        """
        self._object = interface.OBJECT_POSE.publisher(node, prefix)
        self._tip = interface.PUSHER_POSE.publisher(node, prefix)
        self._clock = interface.CLOCK.publisher(node)
        interface.PUSHER_VELOCITY_CMD.subscription(node, self._on_command, prefix)
        self._clients = {
            service: service.client(node, prefix)
            for service in (interface.STOP, interface.RESUME, interface.START)
        }
        self._spinner = Spinner(node)
        self._answers: dict[int, Floats] = {}

    def begin(self, first: TickInput) -> None:
        """Starts the controller anew, whatever it was doing.

        Raises:
            RunError: there is none, or it refuses.
        """
        self.stop()
        self._call(interface.RESUME)
        deadline = time.monotonic() + READY_TIMEOUT
        while not (answer := self._start(first)).success:
            if time.monotonic() > deadline:
                raise RunError(f'mpc_node does not start: {answer.message}')
        self._answers.clear()

    def stop(self) -> None:
        """Stops the controller.

        Raises:
            RunError: there is none.
        """
        self._call(interface.STOP)

    def answer(self, question: TickInput) -> Floats:
        """What the controller sends (2,) [m/s].

        Raises:
            RunError: it does not answer.
        """
        self._answers.clear()
        for _ in range(ATTEMPTS):
            self._show(question)
            if self._happens(lambda: question.stamp in self._answers, PATIENCE):
                return self._answers[question.stamp]
        raise RunError('mpc_node does not answer; run it with mode:=lockstep')

    def _start(self, first: TickInput) -> Any:
        """An attempt to start; the controller wants to have seen poses before."""
        self._show(first)
        self._happens(lambda: False, PATIENCE)
        return self._call(interface.START)

    def _show(self, question: TickInput) -> None:
        self._clock.publish(Clock(clock=to_stamp(question.now)))
        self._tip.publish(question.tip)
        self._object.publish(question.object_pose)

    def _on_command(self, message: TwistStamped) -> None:
        velocity = message.twist.linear
        self._answers[to_nanoseconds(message.header.stamp)] = np.array([velocity.x, velocity.y])

    def _call(self, service: GraphService) -> Any:
        answer = ask(self._clients[service], Trigger.Request(), self._happens)
        if answer is None:
            raise RunError(f'no mpc_node answers {service.name}; see replay --help')
        return answer

    def _happens(self, finished: Callable[[], bool], timeout: float) -> bool:
        end = time.monotonic() + timeout
        while not finished() and time.monotonic() < end:
            self._spinner.once()
        return finished()
