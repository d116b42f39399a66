"""The model that the cell uses when none is named: learned once from simulated pushes, cached.

A plant with other defaults has a model of its own.
"""

import hashlib
import os
import sys
from pathlib import Path

from push_core.common import InputError
from push_gp.models import VERSION, read_sealed
from push_sim.settings import profile

POINTS = 200
SEED = 0


def default_model() -> Path:
    """Path of the model file; collects and trains it where the cache does not hold a good one."""
    path = _cache() / f'simulated_{POINTS}_pushes_seed_{SEED}_plant_{_plant()}.npz'
    if not _is_good(path):
        sys.stderr.write(f'learning the default model from {POINTS} simulated pushes, once\n')
        path.parent.mkdir(parents=True, exist_ok=True)
        _learn(path)
    return path


def _learn(path: Path) -> None:
    # the physics and the optimiser take a second to import: only who learns waits for them
    from push_gp.models.model_file import save_model  # noqa: PLC0415
    from push_gp.training.train import train  # noqa: PLC0415
    from push_sim.collect import collect_pushes  # noqa: PLC0415

    save_model(path, train(collect_pushes(POINTS, SEED)))


def _plant() -> str:
    """What tells one plant from another."""
    world = profile('irb120').world
    return hashlib.sha256(repr(world).encode()).hexdigest()[:12]


def _cache() -> Path:
    home = os.environ.get('XDG_CACHE_HOME') or str(Path.home() / '.cache')
    return Path(home) / 'push_cell'


def _is_good(path: Path) -> bool:
    try:
        header, _ = read_sealed(path)
    except InputError:
        return False
    return header.get('version') == VERSION
