"""Learning curve: error on held-out pushes against the number of training pushes."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from push_core.common import InputError
from push_core.data import PushSet, accuracy
from push_core.geometry import Array

from push_gp.evaluation.uncertainty import score_uncertainty
from push_gp.models import PushModel
from push_gp.training.fit_cone import fitted_cone
from push_gp.training.train import train

SIZES = (5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000)
HELD_OUT = 0.2
"""Share of the pushes that are held out in each seed."""

LIMIT_SURFACE = 'limit_surface'
METHODS = ('zero', 'analytical', LIMIT_SURFACE)
"""A GP with zero mean, a GP over the fitted motion cone, and that cone alone."""


@dataclass(frozen=True)
class CurvePoint:
    """One point of the curve.

    Attributes:
        points: training pushes.
        method: one of `METHODS`.
        nmse: (seeds,) mean NMSE in the push frame on the held-out pushes.
        coverage: (seeds,) mean share within the 95 % interval; NaN for a model without one.
    """

    points: int
    method: str
    nmse: Array
    coverage: Array

    def as_json(self) -> dict[str, object]:
        """The point as `curve --json` prints it."""
        low, median, high = np.quantile(self.nmse, [0.25, 0.5, 0.75]).tolist()
        known = bool(np.isfinite(self.coverage).all())
        return {
            'n': self.points,
            'method': self.method,
            'nmse_push_frame': {
                'median': median,
                'quartiles': [low, high],
                'worst': float(self.nmse.max()),
                'seeds': self.nmse.tolist(),
            },
            'coverage_95': float(self.coverage.mean()) if known else None,
        }


def curve_sizes(count: int, requested: Sequence[int] | None = None) -> list[int]:
    """The requested numbers of training pushes, or those of `SIZES` that `count` pushes allow.

    Raises:
        InputError: there are too few pushes for a requested size, or for any.
    """
    most = count - _held_out(count)
    sizes = [size for size in SIZES if size <= most] if requested is None else list(requested)
    wrong = [size for size in sizes or SIZES[:1] if not 1 <= size <= most]
    if wrong:
        raise InputError(f'cannot train on {wrong[0]}: {count} pushes allow 1 to {most} of them')
    return sizes


def learning_curve(
    pushes: PushSet, sizes: Sequence[int], seeds: int, progress: Callable[[], object]
) -> Iterator[CurvePoint]:
    """Yields the points, by number of pushes and method.

    In each seed the smaller training sets are part of the larger ones, and all are scored on the
    same held-out pushes.

    Args:
        pushes: to draw from.
        sizes: numbers of training pushes.
        seeds: draws of each, from seed 0.
        progress: called after each model.
    """
    draws = [np.random.default_rng(seed).permutation(len(pushes)) for seed in range(seeds)]
    for size in sizes:
        for method in METHODS:
            scores = []
            for draw in draws:
                rest = pushes.take(draw[len(pushes) - _held_out(len(pushes)) :])
                scores.append(_score(_model(pushes.take(draw[:size]), method), rest))
                progress()
            nmse, coverage = np.array(scores).T
            yield CurvePoint(size, method, nmse, coverage)


def _held_out(count: int) -> int:
    return max(2, round(HELD_OUT * count))


def _model(pushes: PushSet, method: str) -> PushModel:
    return fitted_cone(pushes) if method == LIMIT_SURFACE else train(pushes, method)


def _score(model: PushModel, rest: PushSet) -> tuple[float, float]:
    predicted, _ = model.evaluate(rest.p_y, rest.beta)
    score = score_uncertainty(model, rest)
    covered = float(score.coverage_95.mean()) if score else float('nan')
    return float(accuracy(predicted, rest).nmse_push_frame.mean()), covered
