"""Draws the lap of a run for the README: `python docs/lap_picture.py RUN docs/lap.svg`."""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from push_bag import read_run, score_series, tracking_errors


def draw(run_folder: Path, picture: Path) -> None:
    """Reference, path coloured by its error, and what was scored."""
    run = read_run(run_folder)
    score = score_series(run)
    reference = run.reference
    tracking = tracking_errors(run, reference)
    points = 1e3 * tracking.pose[::3, :2]
    error = 1e3 * tracking.distance[::3]
    figure, axes = plt.subplots(figsize=(9.0, 4.9), layout='constrained')
    axes.plot(*(1e3 * reference.pose[:, :2].T), color='0.4', lw=1.0, ls=':', label='reference')
    pieces = LineCollection(np.stack([points[:-1], points[1:]], axis=1), cmap='viridis', lw=2.5)
    pieces.set_array(error[1:])
    axes.add_collection(pieces)
    figure.colorbar(pieces, ax=axes, label='tracking error [mm]', shrink=0.85)
    axes.set(aspect='equal', xlabel='x [mm]', ylabel='y [mm]')
    figures = score['tracking_error_mm']
    axes.set_title(
        f'{score["track"]} at {1e3 * score["speed_m_s"]:.0f} mm/s, profile {score["profile"]}: '
        f'mean error {figures["mean"]:.2f} mm, {score["model"]["points"]} training pushes',
        fontsize=11,
    )
    axes.legend(loc='upper right', frameon=False)
    figure.savefig(picture, metadata={'Date': None})


if __name__ == '__main__':
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
