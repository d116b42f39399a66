"""The nodes of a cell in processes of their own, as from four terminals, and a client of them."""

import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import rclpy
from push_msgs.msg import ControllerState
from push_node import interface
from push_node.ask import ask
from push_node.endpoints import GraphService
from push_node.spin import Spinner
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from std_srvs.srv import Trigger

HANG = 300.0  # [s]; nothing but a hang takes that long
MODULES = {
    'sim_node': 'push_sim.node.sim_node',
    'gp_server': 'push_gp.server.gp_server',
    'mpc_node': 'push_mpc.node.mpc_node',
    'recorder': 'push_bag.record.recorder',
}


class GraphByHand:
    """Starts and kills nodes, calls their services, and keeps the controller's states.

    Attributes:
        processes: newest process of each node.
        states: of the controller, since the last `states.clear()`.
    """

    def __init__(self, environment: dict[str, str], folder: Path) -> None:
        """Starts nothing yet.

        Args:
            environment: variables of the nodes, with their ROS_DOMAIN_ID.
            folder: in which the nodes run.
        """
        self.processes: dict[str, subprocess.Popen[str]] = {}
        self.states: list[ControllerState] = []
        self._environment, self._folder = environment, folder
        rclpy.init(domain_id=int(environment['ROS_DOMAIN_ID']))
        self.node = Node('by_hand')
        self._spinner = Spinner(self.node)
        self._clients: dict[str, Any] = {}
        # lockstep waits for acknowledgements: more than can come while this process sleeps
        deep = QoSProfile(depth=5000)
        interface.CONTROLLER_STATE.subscription(self.node, self.states.append, qos=deep)

    def start(self, name: str, *parameters: str, remapped: Sequence[str] = ()) -> None:
        """Starts a node with NAME:=VALUE parameters and with ROS arguments."""
        options = [word for parameter in parameters for word in ('-p', parameter)]
        log = (self._folder / f'{name}.log').open('a', encoding='utf-8')
        with log:
            self.processes[name] = subprocess.Popen(
                [sys.executable, '-m', MODULES[name], '--ros-args', *options, *remapped],
                env=self._environment,
                cwd=self._folder,
                stderr=log,
                text=True,
            )

    def end(self, name: str, with_signal: int = signal.SIGINT) -> int:
        """Ends a node with a signal and returns its exit status."""
        process = self.processes.pop(name)
        process.send_signal(with_signal)
        return process.wait(timeout=HANG)

    def catches(self, name: str, number: int) -> bool:
        """Whether a node has come so far that it catches a signal."""
        status = Path(f'/proc/{self.processes[name].pid}/status').read_text(encoding='ascii')
        caught = int(next(line for line in status.splitlines() if 'SigCgt' in line).split()[1], 16)
        return bool(caught >> (number - 1) & 1)

    def close(self) -> None:
        """Ends everything."""
        for name in [*self.processes]:
            self.end(name, signal.SIGKILL)
        self._spinner.close()
        self.node.destroy_node()
        rclpy.try_shutdown()

    def happens(self, condition: Callable[[], bool], timeout: float = HANG) -> bool:
        """Whether a condition comes true within a time [s]; handles messages meanwhile."""
        deadline = time.monotonic() + timeout
        while not condition() and time.monotonic() < deadline:
            self._spinner.once()
        return condition()

    def wait(self, condition: Callable[[], bool]) -> None:
        """Waits for a condition."""
        assert self.happens(condition), 'it did not happen'

    def call(self, service: GraphService, request: Any = None) -> Any:
        """The response of a service; None without one."""
        client = self._clients.get(service.name)
        if client is None:
            client = self._clients[service.name] = service.client(self.node)
        return ask(client, request or Trigger.Request(), self.happens)

    def call_until_success(self, service: GraphService) -> None:
        """Calls a service until it succeeds."""
        deadline = time.monotonic() + HANG
        while True:
            answer = self.call(service)
            if answer is not None and answer.success:
                return
            assert time.monotonic() < deadline, answer
            self.happens(lambda: False, 0.1)

    def set(self, node: str, **values: object) -> str:
        """Sets parameters of a node together; why it refused, else an empty string."""
        name = f'{node}/set_parameters_atomically'
        client = self._clients.get(name)
        if client is None:
            client = self.node.create_client(SetParametersAtomically, name)
            self._clients[name] = client
        parameters = [Parameter(key, value=values[key]).to_parameter_msg() for key in values]
        request = SetParametersAtomically.Request(parameters=parameters)
        answer = ask(client, request, self.happens)
        return 'no answer' if answer is None else str(answer.result.reason)

    @property
    def reference_time(self) -> float:
        """Of the newest tick that followed the reference [s]; 0 before one."""
        following = (ControllerState.TRACKING, ControllerState.RECONTACT)
        return next(
            (each.reference_time for each in reversed(self.states) if each.mode in following), 0.0
        )

    @property
    def mode(self) -> int:
        """Of the controller's newest tick; IDLE before one."""
        return self.states[-1].mode if self.states else ControllerState.IDLE
