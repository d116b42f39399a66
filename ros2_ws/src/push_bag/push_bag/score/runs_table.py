"""Scores of several runs: a row for each, mean and spread, or two side by side."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from push_core.common import plain_table

from push_bag.score.bounds import COMPARED, figure

# the figures that fit on a line; the JSON has all of COMPARED
SHOWN = {
    'mean mm': 'tracking_error_mm.mean',
    'truth mm': 'truth.mean',
    'rms mm': 'tracking_error_mm.rms',
    'p95 mm': 'tracking_error_mm.p95',
    'max mm': 'tracking_error_mm.max',
    'cross mm': 'cross_track_mm.rms',
    'deg': 'heading_error_deg.rms',
    'solve p99 ms': 'solve_ms.p99',
    'tick p99 ms': 'tick_ms.p99',
    'misses': 'deadline_misses',
    'lost': 'lost',
}
Scores = Sequence[tuple[str, Mapping[str, Any]]]  # name and score of each run


def runs_table(scores: Scores) -> str:
    """One line for each run, then mean and sample standard deviation over the runs."""
    rows = [('run', 'completed', *SHOWN)]
    for name, score in scores:
        figures = (figure(score, path) for path in SHOWN.values())
        done = {True: 'yes', False: 'no', None: '-'}[score['completed']]
        rows.append((name, done, *map(_number, figures)))
    count = sum(bool(score['completed']) for _, score in scores)
    columns = [_over_runs(scores, path) for path in SHOWN.values()]
    rows.append(('mean', f'{count} of {len(scores)}', *(_number(mean) for mean, _ in columns)))
    rows.append(('spread', '', *(_number(spread) for _, spread in columns)))
    return '\n'.join(plain_table(rows)) + '\n'


def comparison_table(scores: Scores) -> str:
    """One line for each figure: both runs, and the difference second minus first."""
    (first, one), (second, other) = scores
    rows = [('figure', first, second, 'difference')]
    for path in COMPARED:
        before, after = figure(one, path), figure(other, path)
        rows.append((path, _number(before), _number(after), _number(after - before)))
    return '\n'.join(plain_table(rows)) + '\n'


def runs_object(scores: Scores) -> dict[str, Any]:
    """All scores, and mean and spread of each compared figure, for `score --json`."""
    over = {path: _over_runs(scores, path) for path in COMPARED}
    return {
        'runs': [{'run': name, **score} for name, score in scores],
        'mean': {path: _known(mean) for path, (mean, _) in over.items()},
        'spread': {path: _known(spread) for path, (_, spread) in over.items()},
    }


def _over_runs(scores: Scores, path: str) -> tuple[float, float]:
    """Mean and sample standard deviation of a figure; NaN where there are too few values."""
    values = np.array([figure(score, path) for _, score in scores])
    known = values[np.isfinite(values)]
    mean = float(known.mean()) if known.size else math.nan
    return mean, float(known.std(ddof=1)) if known.size > 1 else math.nan


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _number(value: float) -> str:
    return f'{value:.3g}' if math.isfinite(value) else '-'
