"""A launch file as a user starts it, and what it printed."""

import os
import signal
import subprocess
import time
from pathlib import Path

LAUNCH = ('ros2', 'launch', 'push_bringup', 'cell.launch.py')
LINE = ('track:=line', 'controller:=analytical', 'mode:=lockstep')
HANG = 120.0  # [s]; nothing but a hang takes that long


class Launched:
    """A launch in a process group of its own, and its output so far."""

    def __init__(self, environment: dict[str, str], folder: Path, *arguments: str) -> None:
        self.folder = folder
        self._log = folder / f'launch_{time.monotonic_ns()}.log'
        with self._log.open('wb') as output:
            self.process = subprocess.Popen(
                [*LAUNCH, *arguments],
                cwd=folder,
                env=environment,
                stdout=output,
                stderr=output,
                start_new_session=True,
            )

    @property
    def output(self) -> str:
        return self._log.read_text(encoding='utf-8')

    def wait_for(self, text: str) -> None:
        deadline = time.monotonic() + HANG
        while text not in self.output:
            assert self.process.poll() is None, self.output
            assert time.monotonic() < deadline, self.output
            time.sleep(0.1)

    def press_ctrl_c(self) -> None:
        """As a terminal does: the whole group is interrupted."""
        os.killpg(self.process.pid, signal.SIGINT)

    def wait(self) -> str:
        self.process.wait(timeout=HANG)
        return self.output

    def bags(self) -> list[Path]:
        return sorted((self.folder / 'runs').glob('*'))


def is_quiet(output: str) -> bool:
    return not any(word in output for word in ('has died', 'Traceback', 'exit code'))
