"""Pushes laps one after the other in one cell in real time; watches memory, ticks and losses."""

import argparse
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import rclpy
from push_bag.run import read_run
from push_bringup.faults import Case, Outcome
from push_bringup.faults.bed import Bed
from push_bringup.faults.case import Fault
from push_bringup.graph import MODULES
from push_core.common import Parser, run_command
from push_mpc.loop import Mode
from push_node.spin import stop_on_signals
from push_node.start_ros import init_ros

GROWTH = 5.0  # [MB] of memory in a node, from the third lap to the last
MISSES = 1e-3  # share of ticks longer than the period
LONGEST_LAP = 60.0  # [s]
EPILOG = """
Examples: scripts/in_env python tests/tools/load/soak.py --minutes 30
          scripts/in_env python tests/tools/load/soak.py --minutes 480
Exit status: 0 memory, ticks and recording are as they must be, 1 one is not.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the laps."""
    parser = Parser(description=__doc__, epilog=EPILOG)
    parser.add_argument('--minutes', type=float, default=30.0, help='of continuous laps')
    return run_command(parser, work, argv)


def work(arguments: argparse.Namespace) -> int:
    """Runs the laps and prints what grew, was late or was lost."""
    stop_on_signals()
    init_ros()
    case = Case('soak', Fault('', Outcome.CONTINUES, lambda *_: 0.0), 'realtime', 0)
    rows, ends = [], []
    with tempfile.TemporaryDirectory(prefix='push_soak_') as name:
        bed = Bed(case, Path(name), f'soak{time.time_ns() // 1000 % 10**9}', relayed=False)
        end = time.monotonic() + 60.0 * arguments.minutes
        try:
            while time.monotonic() < end:
                bed.begin(0.0)
                bed.wait(lambda: bed.ended, LONGEST_LAP)
                ends.append((bed.observer.mode == Mode.DONE, bed.reason))
                rows.append([memory(bed.processes.pid(node)) for node in MODULES])
                sys.stdout.write(f'lap {len(rows)}: {_memories(rows[-1])}\n')
                sys.stdout.flush()
        finally:
            bed.close()
            rclpy.try_shutdown()
        found = [*growth(np.array(rows)), *of_recording(bed.folder)]
    found += [f'lap {n}: {why}' for n, (done, why) in enumerate(ends, start=1) if not done]
    sys.stdout.write(
        '\n'.join([f'{len(rows)} laps', *(found or ['nothing to complain about']), ''])
    )
    return 1 if found else 0


def memory(pid: int) -> float:
    """Resident memory of a process [MB]."""
    status = Path(f'/proc/{pid}/status').read_text(encoding='utf-8')
    (line,) = (each for each in status.splitlines() if each.startswith('VmRSS'))
    return int(line.split()[1]) / 1024.0


def growth(rows: np.ndarray) -> list[str]:
    """Nodes whose memory (laps, nodes) [MB] has grown."""
    if len(rows) < 4:
        return []
    grown = np.mean(rows[-2:], axis=0) - np.mean(rows[2:4], axis=0)
    return [
        f'{name} has grown by {each:.1f} MB'
        for name, each in zip(MODULES, grown.tolist(), strict=True)
        if each > GROWTH
    ]


def of_recording(folder: Path) -> list[str]:
    """Late ticks, a drift of the tick time, and lost messages."""
    run = read_run(folder)
    ticks = run.state('tick_ms')[run.state('mode') == Mode.TRACKING]
    lost = sum(seen.lost for seen in run.traffic.values())
    late = float(np.mean(ticks > 10.0)) if ticks.size else 0.0
    quarter = max(len(ticks) // 4, 1)
    drift = float(np.median(ticks[-quarter:]) - np.median(ticks[:quarter])) if ticks.size else 0.0
    p50, p99 = np.percentile(ticks, (50, 99)).tolist() if ticks.size else (0.0, 0.0)
    sys.stdout.write(
        f'tick p50 {p50:.2f}, p99 {p99:.2f} ms, {100.0 * late:.3f} % late, '
        f'drift {drift:+.3f} ms; {lost} messages lost\n'
    )
    found = [f'{100.0 * late:.2f} % of the ticks were late'] if late > MISSES else []
    found += [f'the tick time drifts by {drift:+.2f} ms'] if abs(drift) > 0.5 else []
    return found + ([f'{lost} messages lost'] if lost else [])


def _memories(row: Sequence[float]) -> str:
    return ', '.join(f'{name} {each:.1f} MB' for name, each in zip(MODULES, row, strict=True))


if __name__ == '__main__':
    sys.exit(main())
