"""Reads a recorded run into numpy arrays, prints what is in them and draws the path.

`python examples/read_a_bag.py [RUN]`; without RUN it takes the newest one below `runs/`.
"""

import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from push_bag import RunSeries, read_run, score_series


def main() -> None:
    """Reads, prints, draws."""
    run_folder = Path(sys.argv[1]) if sys.argv[1:] else max(Path('runs').iterdir())
    run = read_run(run_folder)
    time = 1e-9 * (run.object.stamp - run.object.stamp[0])
    speed = 1e3 * np.hypot(*run.commands.values.T)
    print(f'{time.size} poses {run.object.values.shape} over {time[-1]:.1f} s')
    print(f'{speed.size} commands, at most {speed.max():.0f} mm/s')
    print(f'solving took {np.median(run.state("solve_ms")[run.following]):.2f} ms (median)')
    print(f'mean tracking error {score_series(run)["tracking_error_mm"]["mean"]:.2f} mm')
    if find_spec('matplotlib'):
        print(f'drawn to {drawn(run, Path("lap.png"))}')


def drawn(run: RunSeries, file: Path) -> Path:
    """Draws the path of the object over its reference."""
    import matplotlib.pyplot as plt  # noqa: PLC0415 - only where it is installed

    figure, axes = plt.subplots()
    if run.reference is not None:
        axes.plot(*run.reference.pose[:, :2].T, label='reference')
    axes.plot(*run.object.values[:, :2].T, label='measured')
    axes.set(aspect='equal', xlabel='x [m]', ylabel='y [m]')
    axes.legend()
    figure.savefig(file)
    return file


if __name__ == '__main__':
    main()
