"""The worked examples of docs/extending.md run, and the files that it names are there."""

import re
import sys
from pathlib import Path

import pytest
from cell_command import Ended

ROOT = Path(__file__).parents[1]
SOURCES = ROOT / 'ros2_ws' / 'src'
PAGE = (ROOT / 'docs' / 'extending.md').read_text(encoding='utf-8')
SECTIONS = dict(re.findall(r'^## (.+?)\n(.*?)(?=^## |\Z)', PAGE, re.DOTALL | re.MULTILINE))
EXAMPLES = {
    heading: example[1]
    for heading, text in SECTIONS.items()
    if (example := re.search(r'```python\n(.*?)```', text, re.DOTALL))
}


@pytest.fixture(scope='module')
def recorded_run(environment: dict[str, str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    line = ('--track', 'line', '--controller', 'analytical', '--mode', 'inprocess')
    ended = Ended.of(environment, *line, '-o', str(tmp_path_factory.mktemp('runs')))
    assert ended.status == 0, ended.err
    return ended.folder


def test_every_section_has_an_example() -> None:
    kinds = ['track', 'model', 'controller', 'engine', 'topic', 'perturbation', 'figure', 'column']
    assert [kind for kind in kinds if not any(kind in heading for heading in EXAMPLES)] == []
    assert set(EXAMPLES) == set(SECTIONS)


@pytest.mark.parametrize('heading', EXAMPLES)
def test_an_example_runs(heading: str, environment: dict[str, str], recorded_run: Path) -> None:
    command = (sys.executable, '-c', EXAMPLES[heading], str(recorded_run))
    ended = Ended.of_command(environment, *command)
    assert ended.status == 0, ended.err


def folder_of(path: str) -> Path:
    """What a path of the page stands for: PACKAGE/wing/ is PACKAGE/PACKAGE/wing/."""
    package, _, rest = path.partition('/')
    kept = rest.startswith(('test/', 'msg/', 'srv/', 'config/'))
    return SOURCES / package / rest if kept else SOURCES / package / package / rest


def test_the_files_that_it_names_are_there() -> None:
    named = re.findall(r'^\| `([^`]+)`', PAGE, re.MULTILINE)
    places = [
        folder_of(path.replace('NAME/', '')) if path.startswith('push_') else ROOT / path
        for path in named
    ]
    assert [str(place) for place in places if not place.exists()] == []
    assert len(places) > 20
