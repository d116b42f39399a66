"""The scripts in examples/ run as their docstrings say, and print what they promise."""

import re
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from cell_command import Ended

EXAMPLES = Path(__file__).parents[1] / 'examples'
Run = Callable[..., str]


@pytest.fixture
def run_example(
    environment: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Run:
    """Runs a script in an empty folder; returns what it printed."""
    monkeypatch.chdir(tmp_path)

    def run(name: str, *arguments: str) -> str:
        script = str(EXAMPLES / name)
        ended = Ended.of_command(environment, sys.executable, script, *arguments)
        assert ended.status == 0, ended.err
        return ended.out

    return run


def number_before(unit: str, text: str) -> float:
    found = re.search(rf'([\d.]+) {re.escape(unit)}', text)
    assert found is not None, text
    return float(found[1])


def test_a_lap_in_process(run_example: Run) -> None:
    assert number_before('mm,', run_example('push_a_lap.py')) < 0.6


def test_a_fitted_motion_cone_helps_a_model_of_few_pushes(run_example: Run) -> None:
    printed = run_example('compare_models.py')
    zero, cone = (float(nmse) for nmse in re.findall(r'NMSE ([\d.]+)', printed))
    assert cone < zero < 0.2


def test_a_bag_as_arrays(run_example: Run, run_cell: Callable[..., Ended], tmp_path: Path) -> None:
    pushed = run_cell('--track', 'line', '--controller', 'analytical', '--mode', 'inprocess')
    assert pushed.status == 0, pushed.err
    printed = run_example('read_a_bag.py')  # the newest below runs/
    assert printed == run_example('read_a_bag.py', str(pushed.folder))
    assert 80.0 < number_before('mm/s', printed) < 160.0
    assert number_before('mm\n', printed) < 2.0
    assert (tmp_path / 'lap.png').stat().st_size > 10_000


@pytest.mark.parametrize('script', sorted(EXAMPLES.glob('*.py')), ids=lambda path: path.name)
def test_an_example_is_short(script: Path) -> None:
    assert len(script.read_text(encoding='utf-8').splitlines()) < 90
