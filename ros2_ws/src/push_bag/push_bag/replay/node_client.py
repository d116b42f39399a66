"""Drives a running mpc_node in lockstep: publishes clock and poses, waits for the command.

The node's time is the published clock, so its commands do not depend on the load of the machine.
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

PATIENCE = 0.2  # [s] to wait for a command before the poses are sent again
ATTEMPTS = 50


@dataclass(frozen=True)
class TickInput:
    """Inputs of one tick.

    Attributes:
        stamp: of the poses [ns].
        now: time of the tick [ns].
        object_pose: as recorded.
        tip: as recorded.
    """

    stamp: int
    now: int
    object_pose: PoseStamped
    tip: PoseStamped


class NodeClient:
    """Takes the place of the simulator."""

    def __init__(self, node: Node, prefix: str) -> None:
        """Creates publishers and clients.

        Args:
            node: to create them on.
            prefix: namespace of the controller's topics and services, ending in a slash.
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
        self._commands: dict[int, Floats] = {}

    def start(self, first: TickInput) -> None:
        """Stops the controller, then starts it from its first tick.

        Raises:
            RunError: no controller answers, or it refuses to start.
        """
        self.stop()
        deadline = time.monotonic() + READY_TIMEOUT
        # the node comes to rest first
        while not self._call(interface.RESUME).success and time.monotonic() < deadline:
            self._wait_until(lambda: False, PATIENCE)
        while not (answer := self._try_to_start(first)).success:
            if time.monotonic() > deadline:
                raise RunError(f'mpc_node does not start: {answer.message}')
        self._commands.clear()

    def stop(self) -> Floats:
        """Stops the controller; returns the command (2,) [m/s] that it sends at once.

        Raises:
            RunError: no controller answers.
        """
        self._commands.clear()
        self._call(interface.STOP)
        self._wait_until(lambda: bool(self._commands), PATIENCE)
        return next(iter(self._commands.values()), np.zeros(2))

    def command(self, inputs: TickInput) -> Floats:
        """The controller's command (2,) for these inputs [m/s].

        Raises:
            RunError: it does not answer.
        """
        self._commands.clear()
        for _ in range(ATTEMPTS):
            self._publish(inputs)
            if self._wait_until(lambda: inputs.stamp in self._commands, PATIENCE):
                return self._commands[inputs.stamp]
        raise RunError('mpc_node does not answer; run it with mode:=lockstep')

    def _try_to_start(self, first: TickInput) -> Any:
        """Calls the start service; the controller starts only after it received poses."""
        self._publish(first)
        self._wait_until(lambda: False, PATIENCE)
        return self._call(interface.START)

    def _publish(self, inputs: TickInput) -> None:
        self._clock.publish(Clock(clock=to_stamp(inputs.now)))
        self._tip.publish(inputs.tip)
        self._object.publish(inputs.object_pose)

    def _on_command(self, message: TwistStamped) -> None:
        velocity = message.twist.linear
        self._commands[to_nanoseconds(message.header.stamp)] = np.array([velocity.x, velocity.y])

    def _call(self, service: GraphService) -> Any:
        answer = ask(self._clients[service], Trigger.Request(), self._wait_until)
        if answer is None:
            raise RunError(f'no mpc_node answers {service.name}; see replay --help')
        return answer

    def _wait_until(self, finished: Callable[[], bool], timeout: float) -> bool:
        end = time.monotonic() + timeout
        while not finished() and time.monotonic() < end:
            self._spinner.once()
        return finished()
