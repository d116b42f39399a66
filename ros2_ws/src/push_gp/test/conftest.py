"""Pushes to learn from: made with the motion cone and noise, and the measured ones."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from push_core.data.push_csv import read_pushes
from push_core.data.push_set import PushSet
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider
from push_gp.models.gp_model import GpModel
from push_gp.regression.kernel import Hyperparameters
from push_gp.training.train import train

DISTANCE = 0.004
NOISE = [1e-4, 1e-4, 4e-3]


def made_pushes(count: int, seed: int) -> PushSet:
    """Pushes as a slider of the nominal friction would answer, with measurement noise."""
    generator = np.random.default_rng(seed)
    p_y = generator.uniform(-0.044, 0.044, count)
    beta = generator.uniform(0.2, 2.9, count)
    rate, _ = MotionCone(Slider(support_radius=0.0348)).evaluate(p_y, beta)
    noise = generator.normal(size=(count, 3)) * NOISE
    return PushSet(p_y, beta, rate * DISTANCE + noise, DISTANCE)


@pytest.fixture(scope='session')
def pushes() -> PushSet:
    return made_pushes(60, seed=1)


@pytest.fixture(scope='session')
def many_pushes() -> PushSet:
    return made_pushes(120, seed=5)


@pytest.fixture(scope='session')
def more_pushes() -> PushSet:
    return made_pushes(12, seed=2)


@pytest.fixture(scope='session')
def model(pushes: PushSet) -> GpModel:
    return train(pushes)


@pytest.fixture(scope='session')
def measured() -> PushSet:
    beside_the_project = Path(__file__).resolve().parents[5] / 'shared' / 'data'
    folder = Path(os.environ.get('PUSH_DATA_DIR', beside_the_project))
    if not folder.is_dir():
        pytest.skip(f'no measured pushes in {folder}; PUSH_DATA_DIR names their folder')
    return read_pushes(folder / 'square_4mm_pushes.csv')


@pytest.fixture(scope='session')
def scikit_learn() -> Callable[[Hyperparameters, np.ndarray, np.ndarray], Any]:
    """Makes scikit-learn's process of given hyperparameters, pushes and displacements."""
    # seconds to import, in every process that collects the tests
    from sklearn import gaussian_process  # noqa: PLC0415

    kernels = gaussian_process.kernels

    def fitted(its: Hyperparameters, inputs: np.ndarray, outputs: np.ndarray) -> Any:
        # their kernel has a half in its exponent, so lengths shrink by sqrt(2)
        lengths = np.array(its.lengthscales) / np.sqrt(2.0)
        kernel = kernels.ConstantKernel(its.signal_std**2) * kernels.RBF(lengths)
        kernel += kernels.WhiteKernel(its.noise_std**2)
        regressor = gaussian_process.GaussianProcessRegressor(kernel, alpha=0.0, optimizer=None)
        return regressor.fit(inputs, outputs)

    return fitted


@pytest.fixture
def queries() -> tuple[np.ndarray, np.ndarray]:
    generator = np.random.default_rng(3)
    return generator.uniform(-0.044, 0.044, 40), generator.uniform(0.2, 2.9, 40)
