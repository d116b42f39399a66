"""Commands of the project as a user runs them, and how they ended."""

import contextlib
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from push_bag.run.run_reader import read_run, read_starts
from push_bag.run.series import RunSeries
from push_core.common.errors import InputError
from push_msgs.msg import ControllerState

CELL = ('ros2', 'run', 'push_bringup', 'cell')
# in real time: a machine that takes the cores away for half a second shall not end the run
PATIENT = ('-p', 'mpc_node.pose_loss:=10.0')
ENDED = (ControllerState.DONE, ControllerState.STOPPED)
HANG = 300.0  # [s]; nothing but a hang takes that long


@dataclass(frozen=True)
class Ended:
    """A command that has ended."""

    status: int
    out: str
    err: str

    @classmethod
    def of(cls, environment: dict[str, str], *arguments: str) -> 'Ended':
        """Runs the cell to its end with the given arguments."""
        return cls.of_command(environment, *CELL, *arguments)

    @classmethod
    def of_command(
        cls, environment: dict[str, str], *command: str, timeout: float = HANG
    ) -> 'Ended':
        """Runs a command to its end; longer than the timeout [s] is a hang."""
        done = subprocess.run(
            command, env=environment, capture_output=True, text=True, timeout=timeout, check=False
        )
        return cls(done.returncode, done.stdout, done.stderr)

    @property
    def folder(self) -> Path:
        """The run's folder, which is the last line printed."""
        return Path(self.out.splitlines()[-1])


def is_pushing(runs: Path) -> bool:
    """Whether the one run in a folder has been pushing for 0.2 s, as far as recorded."""
    try:
        (bag,) = runs.glob('*/*.mcap')
        run = read_run(bag)
    except (InputError, ValueError):
        return False
    tip = run.pusher
    speed = np.hypot(*np.diff(tip.values, axis=0).T) / (np.diff(tip.stamp) * 1e-9)
    # the reset before the first command moves the tip as well, in one jump
    return bool(np.count_nonzero((speed > 0.03) & (speed < 0.3)) > 20)


def wait_until(condition: Callable[[], bool], cell: 'subprocess.Popen[str]') -> None:
    """Waits for a condition while the cell lives."""
    deadline = time.monotonic() + HANG
    while not condition():
        assert cell.poll() is None, cell.communicate()
        assert time.monotonic() < deadline
        time.sleep(0.2)


def wait_until_ended(folder: Path, number: int = 1) -> RunSeries:
    """Waits until a start of a bag that is still being written has ended; returns it."""
    deadline = time.monotonic() + HANG
    while True:
        assert time.monotonic() < deadline
        time.sleep(0.5)
        with contextlib.suppress(InputError):
            runs = read_starts(folder)
            if len(runs) >= number and runs[-1].state('mode')[-1] in ENDED:
                return runs[-1]
