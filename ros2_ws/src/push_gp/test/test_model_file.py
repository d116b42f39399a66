import json
import subprocess
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from push_core.common.errors import InputError
from push_core.data.push_set import PushSet
from push_gp.models.gp_model import GpModel
from push_gp.models.model_file import VERSION, load_model, save_model
from push_gp.models.sealed_archive import read_sealed, write_sealed
from push_gp.training.train import train


@pytest.fixture(scope='module')
def path(model: GpModel, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp('model') / 'model.npz'
    save_model(path, model)
    return path


@pytest.mark.parametrize('mean', ['zero', 'analytical'])
def test_a_loaded_model_answers_bit_for_bit_as_the_saved_one(
    pushes: PushSet, mean: str, queries: tuple[np.ndarray, np.ndarray], tmp_path: Path
) -> None:
    model = train(pushes, mean)
    save_model(tmp_path / 'm.npz', model)
    loaded = load_model(tmp_path / 'm.npz')
    for ours, theirs in zip(loaded.evaluate(*queries), model.evaluate(*queries), strict=True):
        assert np.array_equal(ours, theirs)
    assert np.array_equal(loaded.variance(*queries), model.variance(*queries))
    assert loaded.info.model_hash == model.info.model_hash


def test_equal_models_are_equal_files(model: GpModel, path: Path, tmp_path: Path) -> None:
    save_model(tmp_path / 'again.npz', model)
    assert (tmp_path / 'again.npz').read_bytes() == path.read_bytes()


def test_numpy_and_unzip_read_the_file_too(model: GpModel, path: Path) -> None:
    with np.load(path, allow_pickle=False) as arrays:
        assert np.array_equal(arrays['inputs'], model.pushes.inputs)
    header = json.loads(zipfile.ZipFile(path).read('header.json'))
    assert header['points'] == 60
    assert header['distance_m'] == 0.004
    assert header['training_set_sha256'] == model.pushes.sha256()


def test_no_damaged_file_is_read(path: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    content = path.read_bytes()
    damaged = tmp_path_factory.mktemp('damaged') / 'model.npz'
    places = st.integers(0, len(content) - 1)

    @settings(max_examples=150)
    @given(place=places, other=places, flip=st.integers(1, 255), way=st.sampled_from(range(3)))
    def check(place: int, other: int, flip: int, way: int) -> None:
        changed = bytearray(content)
        if way == 0:
            changed[place] ^= flip
        elif way == 1:
            changed[place], changed[other] = changed[other], changed[place]
        else:
            del changed[place:]
        if bytes(changed) == content:
            return
        damaged.write_bytes(changed)
        with pytest.raises(InputError, match='damaged or no model file'):
            load_model(damaged)

    check()


@pytest.mark.parametrize('content', [b'', b'p_y_m,beta_rad\n', b'PK\x05\x06' + bytes(18)])
def test_a_file_of_another_kind_is_refused(content: bytes, tmp_path: Path) -> None:
    (tmp_path / 'm.npz').write_bytes(content)
    with pytest.raises(InputError, match=r'm\.npz: is damaged or no model file'):
        load_model(tmp_path / 'm.npz')


def test_an_npz_file_of_somebody_else_is_refused(tmp_path: Path) -> None:
    np.savez(tmp_path / 'm.npz', inputs=np.zeros(3))
    with pytest.raises(InputError, match='no model file'):
        load_model(tmp_path / 'm.npz')


def test_a_missing_file_and_a_folder_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='No such file'):
        load_model(tmp_path / 'm.npz')
    with pytest.raises(InputError, match='cannot read'):
        load_model(tmp_path)


def without_weights(_header: dict[str, Any], arrays: dict[str, np.ndarray]) -> None:
    del arrays['weights']


def other_points(header: dict[str, Any], _arrays: dict[str, np.ndarray]) -> None:
    header['points'] = 61


def other_version(header: dict[str, Any], _arrays: dict[str, np.ndarray]) -> None:
    header['version'] = VERSION + 1


def other_format(header: dict[str, Any], _arrays: dict[str, np.ndarray]) -> None:
    header['format'] = 'else'


def other_noise(header: dict[str, Any], _arrays: dict[str, np.ndarray]) -> None:
    header['hyperparameters']['dx']['noise_std'] *= 2.0


def without_hash(header: dict[str, Any], _arrays: dict[str, np.ndarray]) -> None:
    del header['model_sha256']


def other_training_set(header: dict[str, Any], _arrays: dict[str, np.ndarray]) -> None:
    header['training_set_sha256'] = '0' * 64


def other_units(header: dict[str, Any], _arrays: dict[str, np.ndarray]) -> None:
    header['conventions']['units'] = 'millimetres'


def negative_length(header: dict[str, Any], _arrays: dict[str, np.ndarray]) -> None:
    header['hyperparameters']['dy']['lengthscales'][0] = -1.0


def word_for_a_number(header: dict[str, Any], _arrays: dict[str, np.ndarray]) -> None:
    header['hyperparameters']['dy']['signal_std'] = 'big'


def infinite_weight(_header: dict[str, Any], arrays: dict[str, np.ndarray]) -> None:
    arrays['weights'][0, 0] = np.inf


def unknown_mean(header: dict[str, Any], _arrays: dict[str, np.ndarray]) -> None:
    header['mean_function']['kind'] = 'cubic'


def push_outside(_header: dict[str, Any], arrays: dict[str, np.ndarray]) -> None:
    arrays['inputs'][5, 0] = 1.0


@pytest.mark.parametrize(
    ('change', 'fault'),
    [
        (without_weights, 'weights'),
        (other_points, 'do not hold 61 pushes'),
        (other_version, f'format version {VERSION + 1}'),
        (other_format, 'not a model file of push_gp'),
        (other_noise, 'does not match its model_sha256'),
        (without_hash, 'does not match its model_sha256'),
        (other_training_set, 'does not match its training_set_sha256'),
        (other_units, 'does not match its conventions'),
        (negative_length, 'positive'),
        (word_for_a_number, 'inconsistent'),
        (infinite_weight, 'not finite'),
        (unknown_mean, 'cubic'),
        (push_outside, 'push 5: p_y is 1 m'),
    ],
)
def test_a_whole_file_with_wrong_content_is_refused(
    change: Callable[[dict[str, Any], dict[str, np.ndarray]], None],
    fault: str,
    path: Path,
    tmp_path: Path,
) -> None:
    header, arrays = read_sealed(path)
    arrays = {name: values.copy() for name, values in arrays.items()}
    change(header, arrays)
    write_sealed(tmp_path / 'changed.npz', header, arrays)
    with pytest.raises(InputError, match=fault):
        load_model(tmp_path / 'changed.npz')


def test_loading_runs_nothing_from_the_file() -> None:
    sources = Path(__file__).resolve().parents[1] / 'push_gp'
    found = subprocess.run(
        ['grep', '-rlE', r'allow_pickle=True|import pickle', '--include=*.py', sources],
        capture_output=True,
        text=True,
        check=False,
    )
    assert found.stdout == ''
