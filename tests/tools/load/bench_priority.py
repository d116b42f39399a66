"""What priority, core and locked memory are worth beside busy processes (docs/operating.md).

    python tests/tools/load/bench_priority.py --runs 3

Pushes a line in real time with each setting, the settings in turn, while twice as many processes
as there are cores compute. Nothing else should run meanwhile.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from push_core.common import markdown_table

BUSY = 'while True: sum(range(100000))'
LAST = max(os.sched_getaffinity(0))
FIRST = min(os.sched_getaffinity(0))
SETTINGS = {
    'ordinary scheduling': ('realtime.priority:=0',),
    'SCHED_FIFO 20 (default)': (),
    'and locked memory': ('realtime.lock_memory:=true',),
    'and a core for each loop': (
        'realtime.lock_memory:=true',
        f'mpc_node.realtime.cpu:={LAST}',
        f'sim_node.realtime.cpu:={FIRST}',
    ),
}
HEAD = (
    *('asked for', 'laps completed', 'pose to command p50', 'p99', 'max [ms]'),
    *('late commands', 'held still'),
)


@contextmanager
def busy(processes: int) -> Iterator[None]:
    """Processes that compute until the end of the block."""
    started = [subprocess.Popen([sys.executable, '-c', BUSY]) for _ in range(processes)]
    try:
        yield
    finally:
        for process in started:
            process.kill()
            process.wait()


def pushed(changes: tuple[str, ...]) -> dict[str, Any]:
    """The score of a line with changed parameters."""
    words = [word for change in changes for word in ('-p', change)]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [
                *(
                    sys.executable,
                    '-m',
                    'push_bringup.commands.cell',
                    '--controller',
                    'analytical',
                ),
                *('--track', 'line', '--speed', '0.05', '-p', 'mpc_node.pose_loss:=10.0'),
                *(*words, '-o', folder),
            ],
            stdout=subprocess.DEVNULL,
            check=False,
        )
        (score,) = Path(folder).glob('*/score.json')
        found: dict[str, Any] = json.loads(score.read_text(encoding='utf-8'))
        return found


def row(name: str, scores: list[dict[str, Any]]) -> tuple[str, ...]:
    """The smallest and largest figure of all runs of a setting."""

    def span(figure: str) -> str:
        values = [score['pose_to_command_ms'][figure] for score in scores]
        return f'{min(values):.2f} … {max(values):.2f}'

    def total(figure: str) -> str:
        return str(sum(score[figure] for score in scores))

    done = f'{sum(bool(score["completed"]) for score in scores)} of {len(scores)}'
    times = (span(figure) for figure in ('p50', 'p99', 'max'))
    return name, done, *times, total('deadline_misses'), total('holds')


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=3, help='of each setting')
    parser.add_argument('--busy', type=int, default=2 * (os.cpu_count() or 1), help='processes')
    arguments = parser.parse_args()
    scores: dict[str, list[dict[str, Any]]] = {name: [] for name in SETTINGS}
    with busy(arguments.busy):
        for _ in range(arguments.runs):
            for name, changes in SETTINGS.items():
                scores[name].append(pushed(changes))
    print('\n'.join(markdown_table(HEAD, [row(*each) for each in scores.items()])))


if __name__ == '__main__':
    main()
