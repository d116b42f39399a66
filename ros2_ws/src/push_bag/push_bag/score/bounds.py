"""Figures of a score by name, and upper bounds on them (`score --fail-above`).

A figure is named by its path in the score's JSON, such as `tracking_error_mm.mean`; `mean` alone
means that of the tracking error. `lost` is the number of lost messages; `incomplete` is 1 for a
run that was not completed, else 0.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from push_core.common import InputError, RunError

from push_bag.score.score_table import messages_lost

COMPARED = (
    'tracking_error_mm.mean',
    'tracking_error_mm.rms',
    'tracking_error_mm.p95',
    'tracking_error_mm.max',
    'tracking_error_mm.mean_after_start',
    'truth.mean',
    'truth.max',
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
    'pauses.count',
    'pauses.total_s',
    'contact_losses',
    'lost',
)
DEFAULT_GROUP = 'tracking_error_mm'
WORDS = ('stop_reason', 'profile', 'mode', 'recovered_from')
"""Entries of a score that are text, or null."""


@dataclass(frozen=True)
class Bound:
    """The largest allowed value of a figure, in its unit."""

    figure: str
    value: float


def figure(score: Mapping[str, Any], name: str) -> float:
    """A figure of a score; NaN if the run does not have it.

    Raises:
        InputError: a score has no figure of this name.
    """
    if name == 'lost':
        lost = messages_lost(score)
        return math.nan if lost is None else float(lost)
    if name == 'incomplete':
        return float(not score['completed'])
    value: Any = score
    for part in name.split('.'):
        if value is None:
            break
        if not isinstance(value, Mapping) or part not in value:
            raise InputError(f'a score has no figure {name!r}; name one such as {COMPARED[0]}')
        value = value[part]
    if isinstance(value, Mapping | str | list) or name in WORDS:
        raise InputError(f'{name!r} is not a number; name a figure such as {COMPARED[0]}')
    return math.nan if value is None else float(value)


def bound(text: str) -> Bound:
    """Parses a bound of the command line, such as `mean=3.0` or `solve_ms.p99=2`.

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
    """Checks every run against every bound.

    Args:
        scores: name and score of each run.
        bounds: to check; a missing figure exceeds its bound.

    Raises:
        InputError: a score has no such figure.
        RunError: a figure exceeds its bound; names the first one.
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
        return f'{run} has no {broken.figure}, which must not exceed {broken.value:g}'
    return f'{broken.figure} is {value:.4g} in {run}, above {broken.value:g}'
