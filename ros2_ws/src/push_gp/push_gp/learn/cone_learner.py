"""Learns the motion cone while pushing: from short pieces of path first, then lap after lap.

As long as less than a lap is known of a plant, every piece identifies the cone from all pushes so
far. After that laps do, and a new cone that predicts worse is not taken. Pieces then only tell
whether the plant has become another one; if so, what was known is forgotten.
"""

from collections import deque
from dataclasses import replace
from functools import reduce

import numpy as np
from push_core.data import HALF_FACE, PushSet
from push_core.geometry import Array
from push_core.physics import Slider

from push_gp.learn.identification import (
    MISFIT,
    PRIOR_WIDTH,
    STRETCH,
    Identified,
    expected_motion,
    huber_roots,
    identified,
)
from push_gp.models import NOMINAL_DISTANCE, SmoothCone

MEMORY = 2
"""Laps whose pushes count: a plant may change."""

FEWEST = 40
"""Pushes of a lap from which anything is learned."""

FEWEST_OF_PIECES = 8
"""Pushes from which anything is learned within a lap."""

HELD_OUT = 4
"""One stretch of pushes in so many is kept to check a new cone on."""

GROWTH = 1.1
"""Ratio by which pushes must have grown in number to identify the cone again within a lap."""

TOLD = 0.08
"""Change of the logarithm of a parameter within a lap that is worth another plan."""

FASTEST = 0.5
"""Largest change of these logarithms in one piece."""

NOISY = 1.5
"""Loss of the best cone above which pushes tell nothing: the poses are noise, and a cone of noisy
pushes is wrong, not only uncertain."""

MOST = 60
"""Pieces whose pushes count within a lap."""

RECENT = 6
"""Pieces that are compared with the known cone."""

CHANGED = (2.0, 0.3)
"""The plant is another one if the loss of the known cone on recent pieces is larger than that of
their own cone times the first, plus the second."""


class ConeLearner:
    """The motion cone as pushes tell of it.

    Attributes:
        known: the cone so far; the nominal one before the first push.
        speed: of the object in the pushes [m/s], zero where its inertia does not count.
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
        self._nominal, self.speed = nominal, 0.0
        self._laps: deque[PushSet] = deque(maxlen=MEMORY)
        self._pieces: deque[PushSet] = deque(maxlen=MOST)
        self._settled, self._used = known is not None and known.pushes > 0, 0

    def refine(self, pushes: PushSet) -> bool:
        """Takes the pushes of a piece of path; whether the plant has become another one.

        Args:
            pushes: of the piece, in the order of time.
        """
        self._pieces.append(pushes)
        if self._settled:
            self._pieces = deque([*self._pieces][-RECENT:], MOST)
        self._settled |= len(self._pieces) == MOST
        together = _joined(self._pieces)
        if not self._is_worth(together):
            return False
        trial = identified(together, self._nominal, self.speed)
        error = loss(trial.model, together, self.speed)
        another = self._settled and self._is_another(error, together)
        if another:
            self._settled, self._used = False, len(together)
            self._laps.clear()
        if not self._settled and error < NOISY:
            self._approach(trial)
        return another

    def _is_worth(self, pushes: PushSet) -> bool:
        """Whether a cone of these pushes may be another one; identifying it takes a while."""
        if self._settled:
            enough = len(self._pieces) == RECENT and len(pushes) >= FEWEST
            return enough and loss(self.known.model, pushes, self.speed) > CHANGED[1]
        if len(pushes) < max(FEWEST_OF_PIECES, GROWTH * self._used):
            return False
        self._used = len(pushes)
        return True

    def learn(self, pushes: PushSet) -> Identified:
        """The cone after a lap; the one before where the pushes are few or speak against it.

        Args:
            pushes: of the lap, in the order of time.
        """
        if len(pushes) < FEWEST:
            return self.known
        self._settled = True
        self._laps.append(pushes)
        stretch = np.arange(len(pushes)) // STRETCH
        unseen = np.flatnonzero(stretch % HELD_OUT == HELD_OUT - 1)
        trial = identified(_all_of(self._laps, without=unseen), self._nominal, self.speed)
        held_out = pushes.take(unseen)
        error = loss(trial.model, held_out, self.speed)
        if error < NOISY and error <= loss(self.known.model, held_out, self.speed):
            self.known = identified(_joined(self._laps), self._nominal, self.speed)
        return self.known

    def _is_another(self, own_loss: float, recent: PushSet) -> bool:
        factor, more = CHANGED
        return loss(self.known.model, recent, self.speed) > factor * own_loss + more

    def _approach(self, found: Identified) -> None:
        """Moves the known cone towards one, if it is another."""
        change = log_ratio(self.known, found)
        if self.known.pushes and np.abs(change).max() < TOLD:
            return
        step = np.clip(change, -FASTEST, FASTEST)
        if (step != change).any():
            friction, radius = np.exp(step - change).tolist()
            slider = found.model.slider
            slider = replace(
                slider,
                friction_pusher=slider.friction_pusher * friction,
                support_radius=slider.support_radius * radius,
            )
            found = replace(found, model=replace(found.model, slider=slider))
        self.known = found


def log_ratio(before: Identified, after: Identified) -> Array:
    """Change (2,) of the logarithms of friction and support radius."""
    one, other = before.model.slider, after.model.slider
    return np.log(
        [
            other.friction_pusher / one.friction_pusher,
            other.support_radius / one.support_radius,
        ]
    )


def loss(model: SmoothCone, pushes: PushSet, speed: float = 0.0) -> float:
    """Mean Huber loss of a cone on pushes, in units of `MISFIT` of the distance."""
    unit = np.array([1.0, 1.0, 1.0 / HALF_FACE]) * pushes.distance * MISFIT
    expected = expected_motion(model, pushes, speed)
    return float(np.mean(huber_roots((pushes.displacement - expected) / unit) ** 2))


def _joined(parts: deque[PushSet]) -> PushSet:
    return reduce(PushSet.joined, parts)


def _all_of(laps: deque[PushSet], without: np.ndarray) -> PushSet:
    """The pushes of all laps, the last one without some rows."""
    last = laps[-1].take(np.setdiff1d(np.arange(len(laps[-1])), without))
    return _joined(deque([*list(laps)[:-1], last]))
