"""Runs the node graph once: reset, start, watch."""

import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import rclpy
from push_core.common import RunError
from push_core.physics import Slider
from push_msgs.msg import ControllerState, NominalTrajectory
from push_msgs.srv import Reset
from push_node import interface
from push_node.ask import READY_TIMEOUT, ask
from push_node.spin import Spinner, stop_on_signals
from rclpy.client import Client
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import String
from std_srvs.srv import Trigger
from tqdm import tqdm

from push_bringup.graph.processes import Processes

STALL_TIMEOUT = 10.0  # [s] without a tick
RETRY_PERIOD = 0.1  # [s] between two attempts to start
_STOPPED, _DONE = ControllerState.STOPPED, ControllerState.DONE


class Conductor:
    """A node that calls the services of the cell and listens to its controller."""

    def __init__(self, namespace: str, processes: Processes) -> None:
        stop_on_signals()
        rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
        self._node = Node('cell', namespace=namespace)
        self._processes = processes
        self._spinner = Spinner(self._node)
        self._plan: NominalTrajectory | None = None
        self._state: ControllerState | None = None
        self._last_tick = 0.0
        interface.NOMINAL_TRAJECTORY.subscription(self._node, self._on_plan)
        interface.CONTROLLER_STATE.subscription(self._node, self._on_state)
        self._end = interface.RUN_END.publisher(self._node)
        self._reset = interface.RESET.client(self._node)
        self._start = interface.START.client(self._node)

    def close(self) -> None:
        """Leaves the graph."""
        self._node.destroy_node()
        rclpy.try_shutdown()

    def run(self, seed: int) -> str:
        """One run.

        Args:
            seed: of the plant.

        Returns:
            Reason of an early end, else an empty string; it is also published for the recorder.

        Raises:
            KeyboardInterrupt: a stop was requested.
        """
        try:
            reason = self._run(seed)
        except RunError as error:
            reason = str(error)
        self._end.publish(String(data=reason))
        return reason

    def _run(self, seed: int) -> str:
        """Reason of an early stop of the controller, else an empty string.

        Raises:
            RunError: the cell did not become ready, or a node ended.
            KeyboardInterrupt: a stop was requested.
        """
        self._wait(lambda: self._plan is not None, READY_TIMEOUT, 'no plan from mpc_node')
        self._reset_plant(seed)
        self._start_when_ready()
        return self._watch()

    def _reset_plant(self, seed: int) -> None:
        plan = self._plan
        assert plan is not None
        pose = np.array([plan.x[0], plan.y[0], plan.theta[0]])
        slider = Slider(side=plan.side, tip_radius=plan.tip_radius)
        tip = slider.tip_position(pose, plan.p_y[0])
        request = Reset.Request(seed=seed, object_pose=pose, tip_position=tip)
        answer = self._call(self._reset, request)
        if not answer.success:
            raise RunError(f'the plant refused to reset: {answer.message}')

    def _start_when_ready(self) -> None:
        deadline = time.monotonic() + READY_TIMEOUT
        while not (answer := self._call(self._start, Trigger.Request())).success:
            if time.monotonic() > deadline:
                raise RunError(f'the cell did not become ready: {answer.message}')
            self._wait_for(lambda: False, RETRY_PERIOD)

    def _watch(self) -> str:
        assert self._plan is not None
        self._state, self._last_tick = None, time.monotonic()
        with tqdm(
            total=round(self._plan.time[-1], 2), unit='s', desc='pushing', disable=None
        ) as bar:
            while not self._ended():
                self._spin_once()
                if time.monotonic() - self._last_tick > STALL_TIMEOUT:
                    raise RunError(f'no tick of mpc_node for {STALL_TIMEOUT:g} s')
                if self._state is not None and math.isfinite(self._state.reference_time):
                    bar.update(min(max(self._state.reference_time, bar.n), bar.total) - bar.n)
        return str(self._state.stop_reason) if self._state else ''

    def _ended(self) -> bool:
        return self._state is not None and self._state.mode in (_DONE, _STOPPED)

    def _on_plan(self, message: NominalTrajectory) -> None:
        self._plan = message

    def _on_state(self, message: ControllerState) -> None:
        self._state = message
        self._last_tick = time.monotonic()

    def _call(self, client: Client, request: object) -> Any:
        answer = ask(client, request, self._wait_for)
        if answer is None:
            raise RunError(f'no answer from {client.srv_name}')
        return answer

    def _wait(self, finished: Callable[[], bool], timeout: float, complaint: str) -> None:
        if not self._wait_for(finished, timeout):
            raise RunError(f'{complaint} within {timeout:g} s')

    def _wait_for(self, finished: Callable[[], bool], timeout: float) -> bool:
        deadline = time.monotonic() + timeout
        while not finished() and time.monotonic() < deadline:
            self._spin_once()
        return finished()

    def _spin_once(self) -> None:
        """Handles one event, or waits a moment for one."""
        self._processes.check()
        if not self._spinner.once():
            raise KeyboardInterrupt
