"""The time of the reference: when it begins, and where it waits after a pause."""

import math

import numpy as np
from push_core.geometry import Array

from push_mpc.plan import Plan


class ReferenceClock:
    """Time of the reference [s] by the time of the run [s].

    Attributes:
        start: time of the run at which the reference begins.
    """

    def __init__(self) -> None:
        self.start = 0.0
        self.reset()

    def reset(self) -> None:
        """Forgets the run before."""
        self._waits_at = self._before = self._last_exposure = -math.inf

    def at(self, time: float) -> float:
        """Time of the reference at a time of the run; negative before it begins."""
        return max(time - self.start, self._waits_at)

    def is_late(self, exposure: float, catch_up: float) -> bool:
        """Whether an exposure [s] comes more than `catch_up` [s] after the one before."""
        self._before, self._last_exposure = self._last_exposure, exposure
        return catch_up < exposure - self._before < math.inf

    def go_on(self, plan: Plan, place: Array, exposure: float, acts_at: float) -> None:
        """After a pause lets the reference go on from where the object lies.

        Without commands the tip came to rest. The reference waits at the place that is nearest to
        the object, of the part that it ran through meanwhile, until the next command acts.

        Args:
            plan: the reference.
            place: of the object (2,) [m].
            exposure: time of the first measurement after the pause [s].
            acts_at: time at which the next command acts [s].
        """
        begin, end = max(self.at(self._before), 0.0), min(self.at(exposure), plan.duration)
        times = np.arange(begin, end, plan.period)
        if times.size:
            places = np.array([plan.at(time)[0][:2] for time in times])
            self._waits_at = float(times[np.argmin(np.hypot(*(places - place).T))])
            self.start = acts_at - self._waits_at
