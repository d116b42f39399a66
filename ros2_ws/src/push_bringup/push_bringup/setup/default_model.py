"""The default model of the cell: trained once on simulated pushes, cached.

Other sources or libraries make another model: their hash is part of the file's name.
"""

import os
import sys
from pathlib import Path

from push_core.common import InputError
from push_gp.models import ANALYTICAL, VERSION, read_sealed
from push_mpc.settings import CONTROLLERS

from push_bringup.setup.provenance import MODEL_SOURCES, code_key

POINTS = 200
SEED = 0


def model_for(controller: str, given: str | None = None) -> str:
    """Name of the model for a controller: the given file, the default one or 'analytical'."""
    if not CONTROLLERS[controller].trained_model:
        return ANALYTICAL
    return given or str(default_model())


def default_model() -> Path:
    """Path of the model file; collects pushes and trains if the cache holds no valid one."""
    path = _cache() / f'simulated_{POINTS}_pushes_seed_{SEED}_{code_key(MODEL_SOURCES)[:12]}.npz'
    if not _is_valid(path):
        sys.stderr.write(f'learning the default model from {POINTS} simulated pushes, once\n')
        _make_folder(path.parent)
        _train(path)
    return path


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f'no place for the default model, {folder}: {error.strerror}; set XDG_CACHE_HOME to a '
            'folder that can be written'
        ) from error


def _train(path: Path) -> None:
    # the physics and the optimiser take a second to import: only training needs them
    from push_gp.models.model_file import save_model  # noqa: PLC0415
    from push_gp.training.train import train  # noqa: PLC0415
    from push_sim.collect import collect_pushes  # noqa: PLC0415

    save_model(path, train(collect_pushes(POINTS, SEED)))


def _cache() -> Path:
    home = os.environ.get('XDG_CACHE_HOME') or str(Path.home() / '.cache')
    return Path(home) / 'push_cell'


def _is_valid(path: Path) -> bool:
    try:
        header, _ = read_sealed(path)
    except InputError:
        return False
    return header.get('version') == VERSION
