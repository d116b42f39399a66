"""Resets the plant to the start of the plan, unless it starts elsewhere, and starts the run."""

import time

from push_core.common import RunError
from push_node import interface
from push_node.ask import READY_TIMEOUT, WaitsFor, ask
from push_node.endpoints import parameter_clients
from rcl_interfaces.srv import GetParameters
from rclpy.client import Client
from rclpy.node import Node
from std_srvs.srv import Trigger

RETRY_PERIOD = 0.1  # [s] between two attempts


class Starter:
    """Calls the services that begin a run, until each succeeds."""

    def __init__(self, node: Node, waits_for: WaitsFor) -> None:
        """For the cell in the namespace of a node; `waits_for` spins that node."""
        self._waits_for = waits_for
        self._reset = interface.RESET_TO_PLAN.client(node)
        self._start = interface.START.client(node)
        controller = f'{node.get_namespace().rstrip("/")}/mpc_node'
        _, self._parameters = parameter_clients(node, controller)

    def start(self) -> None:
        """Puts the object at the start of the plan and starts the run.

        Where `start_from` of the controller is `here`, the object stays where it lies.

        Raises:
            RunError: a service does not answer, or does not succeed within 30 s.
        """
        if not self._starts_here():
            self._call_until_success(self._reset, 'the plant did not reset')
        self._call_until_success(self._start, 'the cell did not become ready')

    def _call_until_success(self, client: Client, complaint: str) -> None:
        deadline = time.monotonic() + READY_TIMEOUT
        while True:
            answer = ask(client, Trigger.Request(), self._waits_for)
            if answer is None:
                raise RunError(f'no answer from {client.srv_name}')
            if answer.success:
                return
            if time.monotonic() > deadline:
                raise RunError(f'{complaint}: {answer.message}')
            self._waits_for(lambda: False, RETRY_PERIOD)

    def _starts_here(self) -> bool:
        request = GetParameters.Request(names=['start_from'])
        answer = ask(self._parameters, request, self._waits_for)
        if answer is None:
            raise RunError('mpc_node does not answer; is it running?')
        return [value.string_value for value in answer.values] == ['here']
