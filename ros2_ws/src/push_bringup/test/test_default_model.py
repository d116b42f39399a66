"""The default model: trained once, and again where the cached file is not valid."""

import shutil
from pathlib import Path

import pytest
from push_bringup.setup.default_model import default_model
from push_gp.models.model_file import load_model
from push_gp.models.sealed_archive import read_sealed, write_sealed


@pytest.fixture
def cached(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache of its own, with the model that the other tests use."""
    known = default_model()
    path = tmp_path / 'push_cell' / known.name
    path.parent.mkdir()
    shutil.copy(known, path)
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path))
    return path


def test_a_cached_model_is_taken_as_it_is(cached: Path, capsys) -> None:
    before = cached.stat().st_mtime_ns
    assert default_model() == cached
    assert cached.stat().st_mtime_ns == before
    assert capsys.readouterr().err == ''


def test_one_of_an_older_format_is_learned_again(cached: Path, capsys) -> None:
    header, arrays = read_sealed(cached)
    write_sealed(cached, {**header, 'version': header['version'] - 1}, arrays)
    assert len(load_model(default_model()).pushes) == 200
    assert 'once' in capsys.readouterr().err
