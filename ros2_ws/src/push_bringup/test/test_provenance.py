"""What a figure depends on is part of its key."""

import shutil
from pathlib import Path

import push_core
import pytest
from push_bringup.experiment.experiment import Experiment, LapJob
from push_bringup.setup import provenance
from push_bringup.setup.default_model import default_model
from push_bringup.setup.provenance import LAP_SOURCES, MODEL_SOURCES, hash_of_sources


@pytest.fixture
def copied(tmp_path: Path) -> Path:
    """A copy of a package."""
    folder = tmp_path / 'push_core'
    shutil.copytree(Path(push_core.__file__).parent, folder)
    return folder


def test_the_same_sources_have_the_same_hash(copied: Path) -> None:
    installed = Path(push_core.__file__).parent
    assert hash_of_sources(copied) == hash_of_sources(installed)
    (copied / 'notes.txt').write_text('no source')
    assert hash_of_sources(copied) == hash_of_sources(installed)


def test_a_changed_byte_a_new_name_or_a_removed_file_changes_the_hash(copied: Path) -> None:
    source = copied / 'geometry' / 'frames.py'
    hashes = [hash_of_sources(copied)]
    source.write_bytes(source.read_bytes() + b'\n')
    hashes.append(hash_of_sources(copied))
    source.rename(copied / 'geometry' / 'frame.py')
    hashes.append(hash_of_sources(copied))
    (copied / 'geometry' / 'frame.py').unlink()
    hashes.append(hash_of_sources(copied))
    assert len(set(hashes)) == 4


def test_every_package_that_decides_a_figure_is_hashed(monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[str] = []

    def recorded(folder: Path) -> str:
        assert any(folder.rglob('*.py'))
        read.append(folder.name)
        return ''

    monkeypatch.setattr(provenance, 'hash_of_sources', recorded)
    provenance.source_revision.__wrapped__(LAP_SOURCES)
    assert read == sorted(LAP_SOURCES)


@pytest.fixture
def other_code(monkeypatch: pytest.MonkeyPatch):
    """Makes the sources others than those that are installed."""

    def change() -> None:
        monkeypatch.setattr(provenance, 'hash_of_sources', lambda folder: f'other {folder.name}')
        for function in (provenance.source_revision, provenance.code_key):
            function.cache_clear()

    yield change
    for function in (provenance.source_revision, provenance.code_key):
        function.cache_clear()


def test_other_sources_make_another_lap(other_code) -> None:
    def job() -> LapJob:
        return LapJob(Experiment('line', 0.15), 'analytical', 'analytical', 'ideal', 0)

    before = job().key
    assert job().key == before
    other_code()
    assert job().key != before


def test_other_sources_or_libraries_make_another_model(other_code, monkeypatch) -> None:
    keys = {provenance.code_key(MODEL_SOURCES), provenance.code_key(LAP_SOURCES)}
    provenance.code_key.cache_clear()
    monkeypatch.setattr(provenance, 'version', lambda _name: '0.0')
    keys.add(provenance.code_key(MODEL_SOURCES))
    other_code()
    keys.add(provenance.code_key(MODEL_SOURCES))
    assert len(keys) == 4


def test_the_default_model_is_named_after_its_code() -> None:
    assert provenance.code_key(MODEL_SOURCES)[:12] in default_model().name
