"""The model that the cell uses when none is named: learned once from simulated pushes, cached."""

import os
import sys
from pathlib import Path

from push_core.errors import InputError
from push_gp.sealed_archive import read_sealed

POINTS = 200
SEED = 0


def default_model() -> Path:
    """Path of the model file; collects and trains it where the cache does not hold a good one."""
    path = _cache() / f'simulated_{POINTS}_pushes_seed_{SEED}.npz'
    if not _is_good(path):
        sys.stderr.write(f'learning the default model from {POINTS} simulated pushes, once\n')
        path.parent.mkdir(parents=True, exist_ok=True)
        _learn(path)
    return path


def _learn(path: Path) -> None:
    # the physics and the optimiser take a second to import: only who learns waits for them
    from push_gp.learn import learned  # noqa: PLC0415
    from push_gp.model_file import save_model  # noqa: PLC0415
    from push_sim.collect import collect  # noqa: PLC0415

    save_model(path, learned(collect(POINTS, SEED)))


def _cache() -> Path:
    home = os.environ.get('XDG_CACHE_HOME') or str(Path.home() / '.cache')
    return Path(home) / 'push_cell'


def _is_good(path: Path) -> bool:
    try:
        read_sealed(path)
    except InputError:
        return False
    return True
