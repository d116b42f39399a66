"""Pairs of laps over a fast and a slow link: by how much the slow one lets the mean error grow.

    scripts/in_env python tests/tools/cells/link_laps.py --pairs 8

Plant and controller run in two network namespaces (two_machines.py), in real time, so that the
machine should be idle; late commands and pauses in each line say whether it was. Needs root.
"""

import argparse
import os
import sys
import tempfile
from pathlib import Path

from push_bag.score.score import score_series
from two_machines import machines, measured, pushed

LINKS = {
    '0.2 ms': ('--delay', '0.2'),
    '5 ms': ('--delay', '5', '--jitter', '2', '--loss', '0.5'),
}


def mean_error(link: str, seed: int, track: str, folder: Path) -> float:
    """Mean error [mm] of a lap over a link; not a number if the lap did not end well."""
    with machines(*LINKS[link]):
        run = pushed(dict(os.environ), folder, seed, track)
    score = score_series(run)
    error, late = score['tracking_error_mm'], score['deadline_misses']
    way, _ = measured(folder)
    lost = score['messages']['/pusher_velocity_cmd']['lost']
    print(
        f'seed {seed}, {link}: mean {error["mean"]:.3f} max {error["max"]:.2f} mm, '
        f'way {way:.2f} ms, {late} late and {lost} lost commands, '
        f'{score["pauses"]["count"]} pauses, load {os.getloadavg()[0]:.1f} {run.stop_reason}',
        flush=True,
    )
    return float(error['mean']) if score['completed'] else float('nan')


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--pairs', type=int, default=8)
    parser.add_argument('--track', default='circle')
    options = parser.parse_args()
    sums = dict.fromkeys(LINKS, 0.0)
    with tempfile.TemporaryDirectory() as runs:
        for seed in range(options.pairs):
            for link in LINKS:
                folder = Path(runs) / f'{link[0]}_{seed}'
                sums[link] += mean_error(link, seed, options.track, folder)
    fast, slow = sums.values()
    print(f'{options.pairs} pairs: {fast / options.pairs:.3f} mm, {slow / options.pairs:.3f} mm')
    print(f'growth {100.0 * (slow / fast - 1.0):.0f} %')
    return 0 if slow <= 1.2 * fast else 1


if __name__ == '__main__':
    sys.exit(main())
