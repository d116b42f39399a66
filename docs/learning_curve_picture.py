"""Draws a learning curve for the documentation.

`ros2 run push_gp curve PUSHES.csv --json > curve.json`, then
`python docs/learning_curve_picture.py curve.json docs/learning_curve.svg`.
"""

import json
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from push_gp.evaluation.curve import LIMIT_SURFACE

NAMES = {
    'zero': 'GP, zero mean',
    'analytical': 'GP over the fitted motion cone',
    LIMIT_SURFACE: 'fitted motion cone alone',
}


def draw(curve: Path, picture: Path) -> None:
    """Median and quartiles over the seeds of each method."""
    places = json.loads(curve.read_text(encoding='utf-8'))['points']
    figure, axes = plt.subplots(figsize=(7.5, 4.2), layout='constrained')
    for method, name in NAMES.items():
        mine = [place for place in places if place['method'] == method]
        points = [place['n'] for place in mine]
        errors = [place['nmse_push_frame'] for place in mine]
        low, high = np.transpose([error['quartiles'] for error in errors])
        axes.plot(points, [error['median'] for error in errors], marker='o', ms=4, label=name)
        axes.fill_between(points, low, high, alpha=0.2)
    axes.set(xscale='log', yscale='log', xlabel='training pushes', ylabel='mean NMSE, push frame')
    axes.grid(alpha=0.3, which='both')
    axes.legend(frameon=False)
    figure.savefig(picture, metadata={'Date': None})


if __name__ == '__main__':
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
