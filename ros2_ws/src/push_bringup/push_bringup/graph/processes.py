"""The nodes as child processes: started together, watched, stopped in order."""

import ctypes
import signal
import subprocess
import sys
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from push_core.common import RunError

MODULES = {
    'sim_node': 'push_sim.node.sim_node',
    'gp_server': 'push_gp.server.gp_server',
    'mpc_node': 'push_mpc.node.mpc_node',
    'recorder': 'push_bag.record.recorder',
}
STOP_TIMEOUT = 10.0  # [s] from SIGINT to SIGKILL; a killed recorder leaves an unfinished bag
_SET_PARENT_DEATH_SIGNAL = 1
_LIBC = ctypes.CDLL(None)


@dataclass(frozen=True)
class Child:
    """A running node."""

    name: str
    process: 'subprocess.Popen[bytes]'
    log: Path

    def end_message(self) -> str:
        """How the node ended, with the last line of its output."""
        text = self.log.read_text(encoding='utf-8', errors='replace')
        lines = [line for line in text.split('\n') if line.strip()]
        code = self.process.returncode
        killed = code is not None and code < 0
        ended = f'was killed by signal {-code}' if killed else f'ended with status {code}'
        return f'{self.name} {ended}' + (f': {lines[-1]}' if lines else '')


class Processes:
    """The nodes of one cell; as a context manager it stops them all at its end."""

    def __init__(
        self,
        params: Path,
        namespace: str,
        logs: Path,
        modules: Mapping[str, str] = MODULES,
        arguments: Mapping[str, Sequence[str]] = MappingProxyType({}),
        prefixes: Mapping[str, Sequence[str]] = MappingProxyType({}),
    ) -> None:
        """Starts nothing yet.

        Args:
            params: resolved parameter file.
            namespace: of the nodes, '' for none.
            logs: folder for their output.
            modules: of the nodes, by name.
            arguments: further ROS arguments of single nodes.
            prefixes: words before the commands of single nodes, which end in running these.
        """
        self._params = params
        self._namespace = namespace
        self._logs = logs
        self._modules, self._arguments, self._prefixes = modules, arguments, prefixes
        self._children: dict[str, Child] = {}

    def __enter__(self) -> 'Processes':
        return self

    def __exit__(self, *_error: object) -> None:
        self.stop(*self._children)

    def start(self) -> None:
        """Starts all nodes."""
        for name, module in self._modules.items():
            arguments = (*self._ros_arguments(), *self._arguments.get(name, ()))
            prefix = self._prefixes.get(name, ())
            command = [*prefix, sys.executable, '-m', module, '--ros-args', *arguments]
            log = self._logs / f'{name}.log'
            with log.open('wb') as output:
                # its own session: Ctrl-C reaches only the cell, which stops the nodes in order
                process = subprocess.Popen(
                    command,
                    stdin=subprocess.DEVNULL,
                    stdout=output,
                    stderr=output,
                    start_new_session=True,
                    preexec_fn=_end_with_parent,  # noqa: PLW1509  takes no lock of another thread
                )
            self._children[name] = Child(name, process, log)

    def check(self) -> None:
        """Raises if a node has ended.

        Raises:
            RunError: with the name of the node and its last line of output.
        """
        for child in self._children.values():
            if child.process.poll() is not None:
                raise RunError(child.end_message())

    def status(self, name: str) -> int | None:
        """Exit status of a node, None while it runs."""
        return self._children[name].process.poll()

    def pid(self, name: str) -> int:
        """Process id of a node."""
        return self._children[name].process.pid

    def interrupt(self, *names: str) -> None:
        """Interrupts nodes, of those that were started."""
        for child in self._started(names):
            if child.process.poll() is None:
                child.process.send_signal(signal.SIGINT)

    def stop(self, *names: str) -> None:
        """Interrupts nodes, waits for them, and kills those that do not end, with a warning."""
        self.interrupt(*names)
        deadline = time.monotonic() + STOP_TIMEOUT
        for child in self._started(names):
            _wait(child, deadline)

    def _started(self, names: Iterable[str]) -> list[Child]:
        return [self._children[name] for name in names if name in self._children]

    def _ros_arguments(self) -> list[str]:
        arguments = ['--params-file', str(self._params)]
        if self._namespace:
            # rclpy takes long to import, and a cell without a namespace does not need it here
            from push_node.interface import CLOCK  # noqa: PLC0415

            # each cell has its own simulated time
            clock = f'{CLOCK.name}:={CLOCK.short_name}'
            arguments += ['-r', f'__ns:=/{self._namespace}', '-r', clock]
        return arguments


def _wait(child: Child, deadline: float) -> None:
    process = child.process
    try:
        process.wait(max(deadline - time.monotonic(), 0.0))
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        sys.stderr.write(
            f'cell: {child.name} did not end within {STOP_TIMEOUT:g} s and was killed\n'
        )


def _end_with_parent() -> None:
    """Makes the kernel end the node when the cell is killed."""
    _LIBC.prctl(_SET_PARENT_DEATH_SIGNAL, signal.SIGTERM)
