"""A few of the random sequences; `tests/tools/cells/random_sequences.py` runs as many as asked."""

import os
from pathlib import Path

import pytest
from random_sequences import faults_of, make_models

pytestmark = pytest.mark.processes


@pytest.fixture(scope='module')
def models(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp('models')
    make_models(folder)
    return folder


@pytest.mark.parametrize('seed', [1, 2])
def test_whatever_users_do_the_limits_hold_and_the_bags_tell_of_each_start(
    seed: int, models: Path, environment: dict[str, str], tmp_path: Path
) -> None:
    for model in models.iterdir():
        os.link(model, tmp_path / model.name)
    assert faults_of(seed, 12, environment, tmp_path) == []
