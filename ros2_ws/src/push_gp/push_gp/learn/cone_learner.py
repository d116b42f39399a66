"""Learns the motion cone lap after lap, and goes back where a new one predicts worse."""

from collections import deque

import numpy as np
from push_core.data import HALF_FACE, PushSet
from push_core.physics import Slider

from push_gp.learn.identification import (
    MISFIT,
    PRIOR_WIDTH,
    STRETCH,
    Identified,
    huber_roots,
    identified,
)
from push_gp.models import NOMINAL_DISTANCE, SmoothCone

MEMORY = 2
"""Laps whose pushes count: a plant may change."""

FEWEST = 40
"""Pushes of a lap from which anything is learned."""

HELD_OUT = 4
"""One stretch of pushes in so many is kept to check a new cone on."""


class ConeLearner:
    """The motion cone as laps tell of it.

    Attributes:
        known: the cone of the last lap; the nominal one before the first.
    """

    def __init__(
        self,
        nominal: Slider,
        distance: float = NOMINAL_DISTANCE,
        known: Identified | None = None,
    ) -> None:
        """Starts from the nominal cone, or from one that is known.

        Args:
            nominal: slider with the most likely parameters.
            distance: travel of the tip in the pushes [m].
            known: the cone of laps before.
        """
        unknown = Identified(SmoothCone(nominal, distance), np.diag(PRIOR_WIDTH**2), 0)
        self.known = known or unknown
        self._nominal = nominal
        self._laps: deque[PushSet] = deque(maxlen=MEMORY)

    def learn(self, pushes: PushSet) -> Identified:
        """The cone after a lap; the one before where the pushes are few or speak against it.

        Args:
            pushes: of the lap, in the order of time.
        """
        if len(pushes) < FEWEST:
            return self.known
        self._laps.append(pushes)
        stretch = np.arange(len(pushes)) // STRETCH
        unseen = np.flatnonzero(stretch % HELD_OUT == HELD_OUT - 1)
        trial = identified(_all_of(self._laps, without=unseen), self._nominal)
        held_out = pushes.take(unseen)
        if loss(trial.model, held_out) <= loss(self.known.model, held_out):
            self.known = identified(_all_of(self._laps), self._nominal)
        return self.known


def loss(model: SmoothCone, pushes: PushSet) -> float:
    """Mean Huber loss of a cone on pushes, in units of `MISFIT` of the distance."""
    unit = np.array([1.0, 1.0, 1.0 / HALF_FACE]) * pushes.distance * MISFIT
    expected, _ = model.evaluate(pushes.p_y, pushes.beta)
    return float(np.mean(huber_roots((pushes.displacement - expected) / unit) ** 2))


def _all_of(laps: deque[PushSet], without: np.ndarray | None = None) -> PushSet:
    """The pushes of all laps, the last one without some rows."""
    last = laps[-1]
    if without is not None:
        last = last.take(np.setdiff1d(np.arange(len(last)), without))
    joined = laps[0] if len(laps) > 1 else last
    for pushes in [*laps][1:-1]:
        joined = joined.joined(pushes)
    return joined.joined(last) if len(laps) > 1 else joined
