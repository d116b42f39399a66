"""The gate that every measured pose passes before the controller uses it."""

import math
from collections import Counter
from dataclasses import dataclass

from push_core.physics import SafetyLimits

from push_mpc.settings import PoseGateSettings

_MARGIN = 0.2  # [m] around the workspace of the tip, for the object and for overshoot
_NORM_TOLERANCE = 0.01  # of a unit quaternion
_LARGEST_TILT = math.radians(10.0)
_BELIEVED = 4  # poses in a row far from the last one, after which something was really moved
_UNSET = 1e6  # [s]; an older stamp was not set, or is simulated time


@dataclass(frozen=True)
class Rejection:
    """Why a pose was refused.

    Attributes:
        kind: one word: frame, number, quaternion, tilt, workspace, old, future or jump.
        reason: for people, with the values.
    """

    kind: str
    reason: str


class PoseGate:
    """Checks poses, and counts what it refuses by kind.

    Attributes:
        counts: refused poses by kind, since the start of the node.
    """

    def __init__(self, settings: PoseGateSettings, limits: SafetyLimits) -> None:
        """Starts with no refusal.

        Args:
            settings: what is accepted.
            limits: of the tip; its workspace bounds the poses.
        """
        self.counts: Counter[str] = Counter()
        self._settings = settings
        self._places: dict[str, tuple[float, float, float]] = {}
        self._jumps: Counter[str] = Counter()
        self._room = (limits.workspace_x + _MARGIN, limits.workspace_y + _MARGIN)

    def check(
        self,
        what: str,
        frame: str,
        position: tuple[float, float, float],
        quaternion: tuple[float, float, float, float],
        age: float,
    ) -> Rejection | None:
        """Refuses a pose, or returns None.

        Args:
            what: name of the topic, for the reason.
            frame: frame_id of its header.
            position: x, y, z [m].
            quaternion: x, y, z, w.
            age: time [s] from its stamp to now, by the clock of this node.
        """
        kind, reason = (
            self._frame_fault(frame)
            or _number_fault(position, quaternion)
            or _rotation_fault(*quaternion)
            or self._place_fault(*position)
            or self._age_fault(age)
            or self._jump_fault(what, position)
            or ('', '')
        )
        if not kind:
            return None
        self.counts[kind] += 1
        return Rejection(kind, f'{what}: {reason}')

    def forget(self) -> None:
        """Forgets where the last poses were: the plant may have been reset since."""
        self._places.clear()
        self._jumps.clear()

    def _jump_fault(self, what: str, place: tuple[float, float, float]) -> tuple[str, str] | None:
        """Refuses a place that is too far from the last one, unless it is seen again and again."""
        before = self._places.get(what, place)
        away = math.hypot(place[0] - before[0], place[1] - before[1])
        if away <= self._settings.largest_jump or self._jumps[what] >= _BELIEVED:
            self._places[what], self._jumps[what] = place, 0
            return None
        self._jumps[what] += 1
        return 'jump', f'it has jumped by {1e3 * away:.0f} mm, which is no motion'

    def _frame_fault(self, frame: str) -> tuple[str, str] | None:
        if frame in ('', self._settings.frame):
            return None
        return 'frame', f'its frame is {frame!r}, not {self._settings.frame!r}'

    def _place_fault(self, x: float, y: float, _z: float) -> tuple[str, str] | None:
        if abs(x) <= self._room[0] and abs(y) <= self._room[1]:
            return None
        return (
            'workspace',
            f'it is at {x:.4g}, {y:.4g} m, outside the workspace (are these metres?)',
        )

    def _age_fault(self, age: float) -> tuple[str, str] | None:
        settings = self._settings
        if age > _UNSET:
            return 'old', 'its stamp is not set, or is simulated time (lockstep) where ' + (
                'this node runs in real time'
            )
        if age > settings.max_age:
            return 'old', (
                f'its stamp is {age:.3g} s old; are the clocks synchronised? '
                f'(poses.max_age is {settings.max_age:.3g} s)'
            )
        if age < -settings.clock_tolerance:
            return (
                'future',
                f'its stamp lies {-age:.3g} s in the future; are the clocks synchronised?',
            )
        return None


def _number_fault(
    position: tuple[float, ...], quaternion: tuple[float, ...]
) -> tuple[str, str] | None:
    if all(map(math.isfinite, (*position, *quaternion))):
        return None
    return 'number', 'it holds numbers that are not finite'


def _rotation_fault(x: float, y: float, z: float, w: float) -> tuple[str, str] | None:
    norm = math.sqrt(x * x + y * y + z * z + w * w)
    if abs(norm - 1.0) > _NORM_TOLERANCE:
        return 'quaternion', f'its quaternion has the norm {norm:.3g}, which is no rotation'
    tilt = 2.0 * math.asin(min(math.hypot(x, y), 1.0))
    if tilt > _LARGEST_TILT:
        return 'tilt', f'it is tilted by {math.degrees(tilt):.0f} degrees against the table'
    return None
