"""What sets the pace of the plant: the wall clock, or the controller's answers."""

from typing import Protocol

from push_core.geometry import Array

from push_sim.plant import Observation


class Pace(Protocol):
    """Decides when the plant is stepped, and what its time is called outside."""

    late_frames: int
    """Exposures that nobody saw, because the process woke up too late."""

    def restart(self, observation: Observation) -> None:
        """Begins anew after a reset of the plant, which showed this observation."""

    def command(self, velocity: Array, stamp: int) -> None:
        """Takes a velocity (2,) [m/s] that answers the pose of a stamp [ns]."""

    def stamp(self, plant_time: float) -> int:
        """What the topics call a plant time [s], in nanoseconds."""
