"""Design of a collection: speed and length of pushes, range of offsets and directions."""

import math
from dataclasses import dataclass

from push_core.common import InputError, setting, validate
from push_core.data import HALF_FACE

from push_sim.collect.short_push import PushTiming
from push_sim.worlds import COARSE_SUBSTEP


@dataclass(frozen=True)
class PushDesign:
    """By default the paper's pushes: 20 mm/s for 0.2 s, after contact has settled."""

    speed: float = setting(0.02, 'speed of the tip', unit='m/s', low=1e-3, high=0.5)
    duration: float = setting(0.2, 'duration of a push', unit='s', low=0.01, high=10.0)
    settling: float = setting(0.04, 'pushing before the push', unit='s', low=0.0, high=10.0)
    face_part: float = setting(0.95, 'used part of the face', low=0.01, high=1.0)
    steepest: float = setting(
        math.radians(84.0), 'largest angle to the normal', unit='rad', low=0.0, high=1.55
    )

    def __post_init__(self) -> None:
        validate(self)
        for name in ('duration', 'settling'):
            time = getattr(self, name)
            if not math.isclose(time, _steps(time) * COARSE_SUBSTEP, abs_tol=1e-9):
                raise InputError(
                    f'parameter {name} is {time:g}, must be a multiple of {COARSE_SUBSTEP:g} s'
                )
        if self.distance > 2.0 * HALF_FACE:
            raise InputError(
                f'a push of {self.distance:g} m leaves the face: take a shorter duration, so that '
                f'speed times duration is at most {2.0 * HALF_FACE:g} m'
            )

    @property
    def distance(self) -> float:
        """Travel of the tip in a push [m]."""
        return self.speed * self.duration

    @property
    def reach(self) -> float:
        """Longest possible slip along the face, settling included [m]."""
        return self.speed * (self.settling + self.duration)

    @property
    def timing(self) -> PushTiming:
        """The push in time steps of a coarse world."""
        return PushTiming(self.speed, _steps(self.settling), _steps(self.duration))


def _steps(time: float) -> int:
    return round(time / COARSE_SUBSTEP)
