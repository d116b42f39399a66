"""Interface of the physics engines: an object on a table and a tip with a given velocity."""

from collections.abc import Sequence
from typing import Protocol

from push_core.geometry import Array
from push_core.physics import Pair


class World(Protocol):
    """Rigid bodies in the plane; `push_sim.worlds.make_world` makes one of any engine."""

    def reset(self, object_pose: Array, tip_position: Array, seed: int = 0) -> None:
        """Puts everything at rest, independent to the last bit of what happened before.

        Args:
            object_pose: (3,) x [m], y [m], theta [rad].
            tip_position: (2,) centre of the tip [m].
            seed: seed of the random parts of the world.
        """

    def advance(self, tip_velocity: Pair, substeps: int) -> None:
        """Advances some time steps with a constant velocity [m/s] of the tip."""

    def follow(self, tip_velocities: Sequence[Pair]) -> None:
        """Advances one time step for each velocity [m/s] of the tip."""

    def place_object(self, object_pose: Array) -> None:
        """Moves the object to a pose (3,), at rest, without touching anything on the way."""

    def place_tip(self, position: Array) -> None:
        """Moves the centre of the tip to a position (2,) [m] in the same way."""

    def push_object(self, impulse: Array) -> None:
        """Gives the object an impulse (2,) [N s] at its centre in the next time step."""

    def set_friction(self, friction_ground: float, friction_pusher: float) -> None:
        """Uses other coefficients of friction, see `WorldSettings`, from the next time step on."""

    def snapshot(self) -> object:
        """The complete state, for `restore`; taking it has no effect on the world."""

    def restore(self, snapshot: object) -> None:
        """Restores a snapshot of a world with the same settings.

        The world then continues exactly as after the snapshot, to the last bit.

        Raises:
            InputError: the snapshot is of another engine.
        """

    def close(self) -> None:
        """Frees all resources; the world cannot be used afterwards."""

    @property
    def object_pose(self) -> Array:
        """Pose (3,) of the object: x [m], y [m], theta [rad] in [-pi, pi]."""

    @property
    def tip_position(self) -> Array:
        """Centre (2,) of the tip [m]."""

    @property
    def contact(self) -> bool:
        """Whether tip and object were in contact with a normal force in the last time step."""

    @property
    def penetration(self) -> float:
        """Deepest overlap [m] of any two bodies in the last time step."""
