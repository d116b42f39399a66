"""The numbers of a score by name: to compare runs, to average over them, to hold them to a bound.

A figure is named by its path in the score's JSON, `tracking_error_mm.mean`; the figures of the
tracking error may be named without it, `mean`. `lost` is the number of lost messages, `incomplete`
is 1 for a run that was not completed and 0 for one that was.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from push_core.common import InputError, RunError

from push_bag.score.score_table import messages_lost

COMPARED = (
    'tracking_error_mm.mean',
    'tracking_error_mm.rms',
    'tracking_error_mm.p95',
    'tracking_error_mm.max',
    'tracking_error_mm.mean_after_start',
    'cross_track_mm.mean',
    'cross_track_mm.rms',
    'cross_track_mm.max',
    'heading_error_deg.rms',
    'solve_ms.p50',
    'solve_ms.p99',
    'tick_ms.p99',
    'pose_to_command_ms.p50',
    'pose_to_command_ms.p99',
    'deadline_misses',
    'holds',
    'contact_losses',
    'lost',
)
DEFAULT_GROUP = 'tracking_error_mm'
WORDS = ('stop_reason', 'profile', 'mode', 'recovered_from')
"""Of a score; null where a run has none."""


@dataclass(frozen=True)
class Bound:
    """A figure and the value [its unit] that it must not exceed."""

    figure: str
    value: float


def figure(score: Mapping[str, Any], name: str) -> float:
    """One number of a score; NaN where the run has none.

    Raises:
        InputError: a score has no figure of this name.
    """
    if name == 'lost':
        return float(messages_lost(score))
    if name == 'incomplete':
        return float(not score['completed'])
    found: Any = score
    for part in name.split('.'):
        if not isinstance(found, Mapping) or part not in found:
            raise InputError(f'a score has no figure {name!r}; name one such as {COMPARED[0]}')
        found = found[part]
    if isinstance(found, Mapping | str) or name in WORDS:
        raise InputError(f'{name!r} is no number of the score; name one such as {COMPARED[0]}')
    return math.nan if found is None else float(found)


def mean_and_spread(values: Sequence[float]) -> tuple[float, float]:
    """Mean and sample standard deviation; NaN where there are too few values."""
    known = np.array([value for value in values if math.isfinite(value)])
    mean = float(known.mean()) if known.size else math.nan
    return mean, float(known.std(ddof=1)) if known.size > 1 else math.nan


def bound(text: str) -> Bound:
    """A bound as it is written on the command line: `mean=3.0`, `solve_ms.p99=2`.

    Raises:
        InputError: it is written otherwise.
    """
    name, separator, value = text.partition('=')
    try:
        limit = float(value)
    except ValueError:
        limit = math.nan
    if not (name and separator) or math.isnan(limit):
        raise InputError(f'--fail-above {text}: write it as FIGURE=VALUE, such as mean=3.0')
    short = '.' not in name and f'{DEFAULT_GROUP}.{name}' in COMPARED
    return Bound(f'{DEFAULT_GROUP}.{name}' if short else name, limit)


def check_bounds(scores: Sequence[tuple[str, Mapping[str, Any]]], bounds: Sequence[Bound]) -> None:
    """Holds every run to every bound.

    Args:
        scores: name and score of each run.
        bounds: what no figure may exceed; a figure that a run has not exceeds it.

    Raises:
        InputError: a score has no such figure.
        RunError: names the first figures that are too high.
    """
    broken = [
        _complaint(each, figure(score, each.figure), run)
        for run, score in scores
        for each in bounds
        if not figure(score, each.figure) <= each.value
    ]
    if broken:
        others = f' (and {len(broken) - 1} more)' if len(broken) > 1 else ''
        raise RunError(broken[0] + others)


def _complaint(broken: Bound, value: float, run: str) -> str:
    if math.isnan(value):
        return f'{run} has no {broken.figure}, which was not to be above {broken.value:g}'
    return f'{broken.figure} is {value:.4g} in {run}, above {broken.value:g}'
