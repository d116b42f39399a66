"""Model files: reading, writing, and models by name."""

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
from push_core.common import InputError
from push_core.data import OUTPUTS, PushSet
from push_core.geometry import Array
from push_core.physics import Slider

from push_gp.models.analytical_model import ANALYTICAL, NOMINAL_DISTANCE, AnalyticalModel
from push_gp.models.gp_model import GpModel
from push_gp.models.mean_function import ConeMean, MeanFunction, ZeroMean
from push_gp.models.model import PushModel
from push_gp.models.sealed_archive import read_sealed, write_sealed
from push_gp.regression import Hyperparameters

FORMAT = 'push_gp model'
VERSION = 3
CONVENTIONS = {
    'units': 'metres and radians',
    'frame': 'body frame at the start of the push, x along the inward normal of the pushed face',
    'inputs': 'p_y: contact offset along the face; beta = atan2(v_n, v_t): push direction',
    'outputs': 'dx, dy, dtheta: displacement of the centre and rotation by a push of distance_m',
    'kernel': "signal_std^2 exp(-sum_j (x_j - x_j')^2 / lengthscale_j^2), noise_std^2 added",
    'arrays': 'inputs (n, 2), displacement (n, 3), weights (3, n)',
}


def model_named(
    name: str, slider: Slider | None = None, distance: float = NOMINAL_DISTANCE
) -> PushModel:
    """The model that a user names.

    Args:
        name: path of a model file, or 'analytical'.
        slider: of the analytical model; default: the measured square.
        distance: travel of the pusher in one push of the analytical model [m].

    Raises:
        InputError: there is no such model file, or it is not valid.
    """
    if name == ANALYTICAL:
        return AnalyticalModel(slider or Slider(), distance)
    return load_model(Path(name))


def save_model(path: Path, model: GpModel) -> None:
    """Writes a model atomically.

    Raises:
        InputError: the file cannot be written.
    """
    arrays = {
        'inputs': model.pushes.inputs,
        'displacement': model.pushes.displacement,
        'weights': np.stack([process.weights for process in model.processes]),
    }
    write_sealed(path, _header(model), arrays)


def load_model(path: Path) -> GpModel:
    """Reads a model; its predictions equal those of the saved one bit for bit.

    Raises:
        InputError: the file is missing, damaged, of another kind or version, or inconsistent.
    """
    header, arrays = read_sealed(path)
    if header.get('format') != FORMAT:
        raise InputError(f'{path}: is not a model file of push_gp')
    if header.get('version') != VERSION:
        raise InputError(
            f'{path}: has format version {header.get("version")}, not {VERSION}; train it again'
        )
    try:
        model = _model(header, arrays)
    except (InputError, KeyError, TypeError, ValueError) as error:
        raise InputError(f'{path}: is an inconsistent model file ({error!r})') from error
    expected = _header(model)
    for name in ('conventions', 'training_set_sha256', 'model_sha256'):
        if header.get(name) != expected[name]:
            raise InputError(f'{path}: its content does not match its {name}; train it again')
    return model


def _header(model: GpModel) -> dict[str, Any]:
    return {
        'format': FORMAT,
        'version': VERSION,
        'conventions': CONVENTIONS,
        'model_sha256': model.info.model_hash,
        'training_set_sha256': model.info.training_set_hash,
        'points': len(model.pushes),
        'distance_m': model.distance,
        'mean_function': _mean_function_header(model.mean_function),
        'hyperparameters': {
            name: dataclasses.asdict(process.hyperparameters)
            for name, process in zip(OUTPUTS, model.processes, strict=True)
        },
    }


def _mean_function_header(mean_function: MeanFunction) -> dict[str, Any]:
    if isinstance(mean_function, ConeMean):
        slider = dataclasses.asdict(mean_function.cone.slider)
        return {'kind': 'analytical', 'slider': slider}
    return {'kind': 'zero'}


def _model(header: dict[str, Any], arrays: dict[str, Array]) -> GpModel:
    inputs, weights = arrays['inputs'], arrays['weights']
    count = header['points']
    if inputs.shape != (count, 2) or weights.shape != (3, count) or count < 1:
        raise InputError(f'its arrays do not hold {count} pushes')
    if not np.isfinite(weights).all():
        raise InputError('its weights are not finite')
    pushes = PushSet(inputs[:, 0], inputs[:, 1], arrays['displacement'], header['distance_m'])
    hyperparameters = [_hyperparameters(header['hyperparameters'][name]) for name in OUTPUTS]
    mean_function = _mean_function(header['mean_function'], pushes.distance)
    return GpModel.conditioned(pushes, mean_function, hyperparameters, weights)


def _hyperparameters(values: dict[str, Any]) -> Hyperparameters:
    first, second = values['lengthscales']
    return Hyperparameters((first, second), values['signal_std'], values['noise_std'])


def _mean_function(header: dict[str, Any], distance: float) -> MeanFunction:
    if header['kind'] == 'analytical':
        return ConeMean(AnalyticalModel(Slider(**header['slider']), distance))
    if header['kind'] == 'zero':
        return ZeroMean()
    raise InputError(f'unknown mean function {header["kind"]!r}')
