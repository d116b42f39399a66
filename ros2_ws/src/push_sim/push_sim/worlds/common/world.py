"""What the plant needs of a world: an object on a table, and a tip that moves as it is told."""

from collections.abc import Sequence
from typing import Protocol

from push_core.geometry import Array
from push_core.physics import Pair


class World(Protocol):
    """Rigid bodies in the plane; `worlds.make_world` knows the engines."""

    def reset(self, object_pose: Array, tip_position: Array, seed: int = 0) -> None:
        """Puts all at rest; what happened before leaves no trace, to the last bit.

        Args:
            object_pose: (3,) x [m], y [m], theta [rad].
            tip_position: (2,) centre of the tip [m].
            seed: of what the settings let be drawn at random.
        """

    def advance(self, tip_velocity: Pair, substeps: int) -> None:
        """Moves on by some time steps while the tip keeps a velocity [m/s]."""

    def follow(self, tip_velocities: Sequence[Pair]) -> None:
        """Moves on by a time step for each velocity [m/s] of the tip."""

    def place_object(self, object_pose: Array) -> None:
        """Lifts the object and puts it down at rest at a pose (3,)."""

    def place_tip(self, position: Array) -> None:
        """Lifts the tip and puts it down with its centre at a position (2,) [m]."""

    def push_object(self, impulse: Array) -> None:
        """Gives the object an impulse (2,) [N s] at its centre in the next time step."""

    def snapshot(self) -> object:
        """The whole state, for `restore`; taking it changes nothing."""

    def restore(self, snapshot: object) -> None:
        """Goes back to a snapshot of a world of the same settings.

        What follows is what followed the snapshot, to the last bit, whatever happened since.

        Raises:
            InputError: the snapshot is not of such a world.
        """

    def close(self) -> None:
        """Frees what the world holds; it can do nothing more."""

    @property
    def object_pose(self) -> Array:
        """Pose (3,) of the object: x [m], y [m], theta [rad] in [-pi, pi]."""

    @property
    def tip_position(self) -> Array:
        """Centre (2,) of the tip [m]."""

    @property
    def contact(self) -> bool:
        """Whether the tip pressed on the object in the last time step."""

    @property
    def penetration(self) -> float:
        """Deepest overlap [m] of any two bodies in the last time step."""
