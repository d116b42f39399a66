"""Laps in lockstep beside twice as many busy processes as cores: how many messages the bags lack.

    python tests/tools/load/busy_lockstep.py                        20 laps of the eight
    python tests/tools/load/busy_lockstep.py --laps 5 --track line

Prints a line for each lap; the status is 1 if a lap fails or a bag lacks a message.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

CELL = ('ros2', 'run', 'push_bringup', 'cell', '--mode', 'lockstep')


@contextmanager
def busy_cores() -> Iterator[None]:
    """Keeps every core busy with two processes."""
    burners = [
        subprocess.Popen([sys.executable, '-c', 'while True: pass'])
        for _ in range(2 * (os.cpu_count() or 1))
    ]
    try:
        yield
    finally:
        for burner in burners:
            burner.kill()
            burner.wait()


def missing_messages(folder: Path) -> dict[str, int]:
    """Messages that the bag of a scored run lacks, by topic, for topics that lack any."""
    counts = json.loads((folder / 'score.json').read_text())['messages']
    return {topic: seen['lost'] for topic, seen in counts.items() if seen['lost']}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--laps', type=int, default=20)
    parser.add_argument('--track', default='eight')
    options = parser.parse_args()
    whole = 0
    with tempfile.TemporaryDirectory() as runs, busy_cores():
        for lap in range(options.laps):
            begin = time.monotonic()
            command = [*CELL, '--track', options.track, '-o', runs]
            ended = subprocess.run(
                [*command, '--seed', str(lap)], capture_output=True, text=True, check=False
            )
            if ended.returncode:
                print(f'lap {lap}: {ended.stderr.splitlines()[-1]}', flush=True)
                continue
            missing = missing_messages(Path(ended.stdout.splitlines()[-1]))
            whole += not missing
            took = time.monotonic() - begin
            print(f'lap {lap}: {took:.0f} s, missing: {missing or "none"}', flush=True)
    print(f'{whole} of {options.laps} bags are whole')
    return 0 if whole == options.laps else 1


if __name__ == '__main__':
    sys.exit(main())
