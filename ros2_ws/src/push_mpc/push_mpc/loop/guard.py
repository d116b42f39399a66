"""Watches a run for what no controller can mend: frozen cameras, a lost object."""

import math

from push_core.geometry import Array
from push_core.physics import Slider

from push_mpc.settings import ControllerSettings


class Guard:
    """Judges the poses of each tick of a run.

    Attributes:
        frozen: ticks with the same poses as before while the tip was commanded, since the start.
    """

    def __init__(self, settings: ControllerSettings, slider: Slider) -> None:
        self.frozen = 0
        self._slider = slider
        self.change(settings)
        self.reset()

    def change(self, settings: ControllerSettings) -> None:
        """Uses other limits from the next tick on."""
        self._settings = settings.guard

    def reset(self) -> None:
        """Forgets the run before."""
        self._seen: tuple[bytes, bytes] | None = None
        self._same_since = self._inside_since = math.nan

    def fault(
        self, object_pose: Array, tip: Array, reference: Array, commanded: bool, time: float
    ) -> str:
        """Why the run must end, empty if it need not; call it once for each tick.

        Args:
            object_pose: measured (3,) [m, m, rad].
            tip: measured (2,) [m].
            reference: position (2,) [m] of the reference at that instant.
            commanded: whether the last command was not zero.
            time: of the measurement [s].
        """
        away = math.hypot(*(object_pose[:2] - reference))
        if away > self._settings.tracking_error:
            return f'the object is {1e3 * away:.0f} mm from its reference'
        frozen = self._frozen_fault(object_pose, tip, commanded, time)
        return frozen or self._overlap_fault(object_pose, tip, time)

    def _frozen_fault(self, object_pose: Array, tip: Array, commanded: bool, time: float) -> str:
        seen = object_pose.tobytes(), tip.tobytes()
        same = commanded and seen == self._seen
        self._seen = seen
        self.frozen += same
        if not same or math.isnan(self._same_since):
            self._same_since = time
        lasted = time - self._same_since
        if lasted <= self._settings.frozen:
            return ''
        return f'the poses have not changed for {1e3 * lasted:.0f} ms' + (
            ' although the tip is commanded to move: is the camera frozen, or the robot off?'
        )

    def _overlap_fault(self, object_pose: Array, tip: Array, time: float) -> str:
        slider = self._slider
        depth = -slider.gap(object_pose, tip)
        deep = self._settings.overlap < depth < slider.side
        deep = deep and abs(slider.contact_offset(object_pose, tip)) < 0.5 * slider.side
        if not deep or math.isnan(self._inside_since):
            self._inside_since = time
        if time - self._inside_since <= self._settings.frozen:
            return ''
        return f'the tip is measured {1e3 * depth:.0f} mm inside the object'
