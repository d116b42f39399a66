"""A cell into which faults are put: its nodes, a relay for its poses, an observer."""

import os
import signal
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from push_core.common import RealtimeSettings, RunError
from push_mpc.loop import Mode
from push_mpc.plan import planned
from push_node import interface
from push_node.ask import ask
from push_node.realtime import schedule_alone
from push_node.spin import Spinner
from rclpy.node import Node
from std_srvs.srv import Trigger

from push_bringup.faults.case import Case
from push_bringup.faults.link import Link
from push_bringup.faults.observer import Observer
from push_bringup.faults.relay import Relay, remappings
from push_bringup.faults.sick import FAULT_FILE
from push_bringup.graph import MODULES, Processes
from push_bringup.graph.starter import Starter
from push_bringup.setup import (
    PARAMETERS_FILE,
    Request,
    installed_config,
    recorded_in,
    resolved,
    write_inputs,
)

TRACK, SPEED = 'circle', 0.08
DOMAINS = 102  # that work on every system
_PRIORITY = RealtimeSettings().priority // 2
_PATIENCE = 60.0  # [s] for the nodes to be ready
# the relay adds to the age of the poses, on a busy machine more than a real way
_SLOW_WAY = {'poses.max_age': 0.15}  # [s]
_SICK = {
    'mpc_node': 'push_bringup.faults.sick.controller',
    'gp_server': 'push_bringup.faults.sick.server',
}


class Bed:
    """The nodes of one cell, for one case after the other.

    Attributes:
        node: in the cell's namespace, for whatever a fault needs.
        relay: between cameras and controller.
        observer: of the cell.
        processes: the nodes.
        folder: of the recording.
    """

    def __init__(self, case: Case, folder: Path, namespace: str, *, relayed: bool = True) -> None:
        """Starts the nodes.

        Args:
            case: the first one; the others must need the same cell.
            folder: for parameters, logs and the recording.
            namespace: of the nodes.
            relayed: whether the poses go through the relay.
        """
        self._scratch, self._namespace = folder, namespace
        # before the first node, which takes up the addresses that there are
        self._link = Link() if case.fault.far else None
        self._sick_file = folder / 'sick'
        os.environ[FAULT_FILE] = str(self._sick_file)
        self._parameters, self.folder = _written(case, folder, namespace)
        self.node = Node('faults', namespace=namespace)
        self._spinner = Spinner(self.node)
        self.relay, self.observer = Relay(self.node, relayed), Observer(self.node)
        modules = {**MODULES, **{name: _SICK[name] for name in case.fault.sick}}
        arguments = {'sim_node': remappings()} if relayed else {}
        prefixes = dict.fromkeys(case.fault.far, self._link.prefix) if self._link else {}
        self.processes = Processes(
            self._parameters, namespace, folder, modules, arguments, prefixes
        )
        self._starter = Starter(self.node, self.wait)
        self._stop, self._resume = (
            service.client(self.node) for service in (interface.STOP, interface.RESUME)
        )
        self.processes.start()
        # the relay must not be what is late, nor delay the loops
        schedule_alone(_PRIORITY if case.mode == 'realtime' else 0)

    def close(self) -> None:
        """Ends the nodes."""
        for name in MODULES:
            self.signal(name, signal.SIGCONT)
        self.processes.interrupt('mpc_node', 'gp_server')
        self.spin(0.3)
        self.processes.stop('sim_node', 'mpc_node', 'gp_server')
        self.processes.stop('recorder')
        self._spinner.close()
        self.node.destroy_node()
        if self._link is not None:
            self._link.close()

    @property
    def link(self) -> Link:
        """To the nodes that are far."""
        assert self._link is not None
        return self._link

    def begin(self, moment: float) -> None:
        """Starts a run and waits for a moment [s] of the reference.

        Raises:
            RunError: the run does not begin or does not get there.
        """
        ready = self.wait(lambda: self.observer.plan is not None, _PATIENCE)
        if not ready:
            raise RunError('no plan from mpc_node')
        self.release()
        self._starter.start()
        self.observer.forget()
        arrived = self.wait(
            lambda: self.observer.reference_time >= moment or self.ended, _PATIENCE
        )
        if not arrived or self.ended:
            raise RunError(f'the run ended before the fault: {self.reason}')

    def release(self) -> None:
        """Heals what was made sick and brings the controller back to IDLE.

        Raises:
            RunError: a node has ended.
        """
        self.relay.spoil = None
        self.make_sick('')
        self.processes.check()
        ask(self._stop, Trigger.Request(), self.wait)
        self.wait(self._released, 10.0)

    def _released(self) -> bool:
        answer = ask(self._resume, Trigger.Request(), self.wait)
        return answer is not None and bool(answer.success)

    @property
    def ended(self) -> bool:
        """Whether the controller is in a mode in which a run has ended."""
        return self.observer.mode in (Mode.DONE, Mode.STOPPED, Mode.FAULT)

    @property
    def reason(self) -> str:
        """Why the controller stopped, or which node has ended."""
        if self.observer.seen.reasons:
            return self.observer.seen.reasons[0]
        try:
            self.processes.check()
        except RunError as error:
            return str(error)
        return ''

    def call(self, service: Any) -> Any:
        """Response of a service without arguments."""
        return ask(service.client(self.node), Trigger.Request(), self.wait)

    def make_sick(self, how: str) -> None:
        """Makes the nodes that can be sick so, see `push_bringup.faults.sick`; '' heals them."""
        self._sick_file.write_text(how, encoding='utf-8')

    @contextmanager
    def neighbour(self, namespace: str, domain: int) -> Iterator[None]:
        """Another cell with the same parameters, as long as the context lasts.

        Args:
            namespace: of its nodes, added to that of this cell.
            domain: added to the ROS domain.
        """
        scratch = Path(tempfile.mkdtemp(prefix='neighbour_', dir=self._scratch))
        recorder = ['-p', f'folder:={scratch / "run"}']
        own = os.environ.get('ROS_DOMAIN_ID', '0') or '0'
        os.environ['ROS_DOMAIN_ID'] = str((int(own) + domain) % DOMAINS)
        nodes = Processes(
            self._parameters, self._namespace + namespace, scratch, MODULES, {'recorder': recorder}
        )
        try:
            with nodes:
                nodes.start()
                os.environ['ROS_DOMAIN_ID'] = own
                yield
                nodes.interrupt(*MODULES)
                # the relay of this cell runs meanwhile
                self.wait(lambda: all(nodes.status(name) is not None for name in MODULES), 15.0)
        finally:
            os.environ['ROS_DOMAIN_ID'] = own

    def signal(self, name: str, number: int) -> None:
        """Sends a signal to a node, if it lives."""
        if self.processes.status(name) is None:
            os.kill(self.processes.pid(name), number)

    def now(self) -> int:
        """The time of the stamps [ns]: of the system, in lockstep of the plant."""
        tips = self.observer.seen.tips
        return tips[-1][0] if self.is_lockstep and tips else time.time_ns()

    @property
    def is_lockstep(self) -> bool:
        """Whether the cell runs in lockstep."""
        tips = self.observer.seen.tips
        return bool(tips) and tips[-1][0] < time.time_ns() // 2

    def spin(self, duration: float) -> None:
        """Observes for a time [s]."""
        self.wait(lambda: False, duration)

    def wait(self, finished: Callable[[], bool], timeout: float) -> bool:
        """Observes until a condition holds, at most for a time [s]; whether it holds."""
        end = time.monotonic() + timeout
        while not finished() and time.monotonic() < end:
            if not self._spinner.once():
                raise KeyboardInterrupt
            self.observer.awake()
        return bool(finished())


def _written(case: Case, folder: Path, namespace: str) -> tuple[Path, Path]:
    """Writes the files of a cell; returns the parameter file and the folder of the recording."""
    request = Request(
        track=TRACK,
        speed=SPEED,
        controller='gp',
        mode=case.mode,
        seed=int(np.uint32(case.seed)),
        output=folder,
        namespace=namespace,
        overrides={**_SLOW_WAY, **case.fault.parameters},
    )
    parameters = recorded_in(
        resolved(request, installed_config('cell.yaml')), folder / 'run', folder
    )
    write_inputs(request, parameters, planned(parameters.mpc), folder)
    return folder / PARAMETERS_FILE, folder / 'run'
