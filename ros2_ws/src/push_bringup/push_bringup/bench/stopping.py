"""`bench stopping`: how long a cell takes to end when it is interrupted during a lap."""

import argparse
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from statistics import median

import numpy as np
from push_bag.run import read_run
from push_core.common import InputError, Parser, RunError, json_text, run_command
from push_msgs.msg import ControllerState
from tqdm import tqdm

from push_bringup.bench.options import check_positive

READY_TIMEOUT = 120.0  # [s] from the command to the first push
POLL_PERIOD = 0.2  # [s]
EPILOG = """Example: bench stopping --runs 5
Each run of `cell` is interrupted as by Ctrl-C once it tracks. The time is from the signal to the
end of the command: the tip is at rest, all nodes have ended, the bag is finished.
Nothing else should run meanwhile.
Exit status: 0 each left a finished bag, 1 one did not, 2 the command was wrong.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser('Interrupts the cell during a lap, in real time.', EPILOG)
    described.prog = 'bench stopping'
    described.add_argument(
        '--runs', type=int, default=5, help='number of runs (default %(default)s)'
    )
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    return described


def work(arguments: argparse.Namespace) -> int:
    """Interrupts runs and prints how long they took to end.

    Raises:
        InputError: a number is out of range.
        RunError: a run did not reach tracking, or its bag is not finished.
    """
    check_positive('--runs', arguments.runs)
    runs = tqdm(range(arguments.runs), 'stopping', unit=' runs', disable=None)
    seconds = [stopping_time() for _ in runs]
    results = {'runs': len(seconds), 'median_s': median(seconds), 'max_s': max(seconds)}
    if arguments.json:
        sys.stdout.write(json_text(results))
    else:
        sys.stdout.write(text(seconds))
    return 0


def text(seconds: Sequence[float]) -> str:
    """The line to print."""
    return (
        f'from the signal to the end of the cell: median {median(seconds):.2f} s, '
        f'largest {max(seconds):.2f} s of {len(seconds)} runs\n'
    )


def stopping_time() -> float:
    """Time [s] that one run of the cell takes to end after SIGINT.

    Raises:
        RunError: the run did not reach tracking, or its bag is not finished.
    """
    with tempfile.TemporaryDirectory(prefix='push_stopping_') as name:
        folder = Path(name)
        module = ('-m', 'push_bringup.commands.cell')
        command = [sys.executable, *module, '--controller', 'analytical']
        with subprocess.Popen([*command, '-o', name], stderr=subprocess.DEVNULL) as cell:
            try:
                _wait_until_tracking(folder, cell)
                interrupted = time.monotonic()
                cell.send_signal(signal.SIGINT)
                cell.wait()
                seconds = time.monotonic() - interrupted
            finally:
                cell.kill()
        if not list(folder.glob('*/metadata.yaml')):
            raise RunError('an interrupted cell left an unfinished bag')
    return seconds


def is_tracking(folder: Path) -> bool:
    """Whether the recording of the run in a folder has reached tracking."""
    try:
        (bag,) = folder.glob('*/*.mcap')
        modes = read_run(bag).state('mode')
    except (InputError, ValueError):
        return False
    return bool(np.any(modes == ControllerState.TRACKING))


def _wait_until_tracking(folder: Path, cell: 'subprocess.Popen[bytes]') -> None:
    end = time.monotonic() + READY_TIMEOUT
    while not is_tracking(folder):
        if cell.poll() is not None or time.monotonic() > end:
            raise RunError(f'the cell did not track within {READY_TIMEOUT:g} s; does `cell` run?')
        time.sleep(POLL_PERIOD)


if __name__ == '__main__':
    sys.exit(main())
