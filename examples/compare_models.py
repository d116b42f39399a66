"""Trains two models on a few pushes and compares their errors on pushes that neither has seen.

`python examples/compare_models.py [PUSHES.csv]`; without a file the pushes are simulated.
"""

import sys
from pathlib import Path

import numpy as np
from push_core import PushSet, read_pushes
from push_gp import evaluate, random_rows, train
from push_sim import collect_pushes

POINTS = 20


def main() -> None:
    """Prints one line for each model."""
    pushes = read_pushes(Path(sys.argv[1])) if sys.argv[1:] else collect_pushes(300, seed=0)
    rows = random_rows(pushes, POINTS, seed=0)
    training, rest = pushes.take(rows), pushes.take(np.setdiff1d(np.arange(len(pushes)), rows))
    print(f'{len(training)} training pushes, errors on {len(rest)} others')
    for mean in ('zero', 'analytical'):
        print(f'{mean:10} mean function: {figures(training, rest, mean)}')


def figures(training: PushSet, rest: PushSet, mean: str) -> str:
    """Error of a model with the given mean function."""
    evaluation = evaluate(train(training, mean), rest)
    nmse = evaluation.accuracy.nmse_push_frame.mean()
    x, y, _ = 1e3 * evaluation.accuracy.rmse
    return f'NMSE {nmse:.3f}, RMSE {x:.2f} mm along x, {y:.2f} mm along y'


if __name__ == '__main__':
    main()
