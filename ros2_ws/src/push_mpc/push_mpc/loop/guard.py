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
        self._settings, self._period = settings.guard, settings.period

    def reset(self) -> None:
        """Forgets the run before."""
        self._seen: tuple[bytes, bytes] | None = None
        self._same = self._inside = 0

    def fault(self, object_pose: Array, tip: Array, reference: Array, commanded: bool) -> str:
        """Why the run must end, empty if it need not; call it once for each tick.

        Args:
            object_pose: measured (3,) [m, m, rad].
            tip: measured (2,) [m].
            reference: position (2,) [m] of the reference at that instant.
            commanded: whether the last command was not zero.
        """
        away = math.hypot(*(object_pose[:2] - reference))
        if away > self._settings.tracking_error:
            return f'the object is {1e3 * away:.0f} mm from its reference'
        return self._frozen_fault(object_pose, tip, commanded) or self._overlap_fault(
            object_pose, tip
        )

    def _frozen_fault(self, object_pose: Array, tip: Array, commanded: bool) -> str:
        seen = object_pose.tobytes(), tip.tobytes()
        same = commanded and seen == self._seen
        self._seen = seen
        self._same = self._same + 1 if same else 0
        self.frozen += same
        if not self._lasts(self._same):
            return ''
        return f'the poses have not changed for {1e3 * self._same * self._period:.0f} ms' + (
            ' although the tip is commanded to move: is the camera frozen, or the robot off?'
        )

    def _overlap_fault(self, object_pose: Array, tip: Array) -> str:
        slider = self._slider
        depth = -slider.gap(object_pose, tip)
        deep = self._settings.overlap < depth < slider.side
        deep = deep and abs(slider.contact_offset(object_pose, tip)) < 0.5 * slider.side
        self._inside = self._inside + 1 if deep else 0
        if not self._lasts(self._inside):
            return ''
        return f'the tip is measured {1e3 * depth:.0f} mm inside the object'

    def _lasts(self, ticks: int) -> bool:
        return ticks * self._period > self._settings.frozen
