"""The state of a physics server as bytes: bodies, velocities and the contacts' cached forces.

PyBullet can only write it to a file and read it from one; a snapshot kept inside the server could
not go to another one, and would hold its memory until it is told to forget it.
"""

import tempfile
from pathlib import Path

from push_sim.bullet import pybullet


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
