"""The state of a physics server as bytes: bodies, velocities and the contacts' cached forces.

PyBullet can only write it to a file and read it from one; a snapshot kept inside the server could
not go to another one, and would hold its memory until it is told to forget it.
"""

import tempfile
from dataclasses import dataclass
from pathlib import Path

from push_core.physics import Pair

from push_sim.worlds.bullet.silent_pybullet import pybullet
from push_sim.worlds.bullet.symmetry import Symmetry


@dataclass(frozen=True)
class BulletSnapshot:
    """The whole state of a `BulletWorld`.

    Attributes:
        server: that of the physics server.
        seed: of what was drawn at the reset.
        axes: pose and side of the axes of the physics.
        symmetry: how the push is seen.
        aligned: whether that has been settled.
        steps_left: until the axes follow the slider again.
        knocked_steps: for which a knock may last.
        impulse: that the next time step gives, if any [N s].
    """

    server: bytes
    seed: int
    axes: tuple[float, float, float, float]
    symmetry: Symmetry
    aligned: bool
    steps_left: int
    knocked_steps: int
    impulse: Pair | None


def server_state(client: int) -> bytes:
    """The state of a physics server."""
    with tempfile.TemporaryDirectory(prefix='push_sim_') as folder:
        path = Path(folder) / 'state.bullet'
        pybullet.saveBullet(str(path), physicsClientId=client)
        return path.read_bytes()


def put_server_state(client: int, state: bytes) -> None:
    """Puts a physics server of the same bodies into a state."""
    with tempfile.TemporaryDirectory(prefix='push_sim_') as folder:
        path = Path(folder) / 'state.bullet'
        path.write_bytes(state)
        pybullet.restoreState(fileName=str(path), physicsClientId=client)
