"""The model that the cell uses when none is named: learned once from simulated pushes, cached."""

import os
import sys
from pathlib import Path

from push_core.errors import InputError
from push_gp.learn import learned
from push_gp.model_file import load_model, save_model
from push_sim.collect import collect

POINTS = 200
SEED = 0


def default_model() -> Path:
    """Path of the model file; collects and trains it where the cache does not hold a good one."""
    path = _cache() / f'simulated_{POINTS}_pushes_seed_{SEED}.npz'
    if not _is_good(path):
        sys.stderr.write(f'learning the default model from {POINTS} simulated pushes, once\n')
        path.parent.mkdir(parents=True, exist_ok=True)
        save_model(path, learned(collect(POINTS, SEED)))
    return path


def _cache() -> Path:
    home = os.environ.get('XDG_CACHE_HOME') or str(Path.home() / '.cache')
    return Path(home) / 'push_cell'


def _is_good(path: Path) -> bool:
    try:
        load_model(path)
    except InputError:
        return False
    return True
