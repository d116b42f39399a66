"""The state of a physics server as bytes: poses, velocities and cached contact forces.

PyBullet writes and reads it only as a file. Its snapshots in memory cannot be restored in another
server, and each one stays allocated until it is removed.
"""

import tempfile
from dataclasses import dataclass
from pathlib import Path

from push_core.physics import Pair

from push_sim.worlds.bullet.silent_pybullet import pybullet
from push_sim.worlds.bullet.symmetry import Symmetry


@dataclass(frozen=True)
class BulletSnapshot:
    """The complete state of a `BulletWorld`.

    Attributes:
        server: state of the physics server.
        seed: seed of the reset.
        axes: pose and side of the physics axes.
        symmetry: map of the push to the canonical face and half.
        aligned: whether this map has been chosen since the reset.
        steps_left: time steps until the axes follow the slider again.
        sliding_steps: time steps for which the object may slide after an impulse.
        impulse: impulse of the next time step [N s], or None.
    """

    server: bytes
    seed: int
    axes: tuple[float, float, float, float]
    symmetry: Symmetry
    aligned: bool
    steps_left: int
    sliding_steps: int
    impulse: Pair | None


def server_state(client: int) -> bytes:
    """The state of a physics server."""
    with tempfile.TemporaryDirectory(prefix='push_sim_') as folder:
        path = Path(folder) / 'state.bullet'
        pybullet.saveBullet(str(path), physicsClientId=client)
        return path.read_bytes()


def restore_server_state(client: int, state: bytes) -> None:
    """Restores a state in a physics server with the same bodies."""
    with tempfile.TemporaryDirectory(prefix='push_sim_') as folder:
        path = Path(folder) / 'state.bullet'
        path.write_bytes(state)
        pybullet.restoreState(fileName=str(path), physicsClientId=client)
