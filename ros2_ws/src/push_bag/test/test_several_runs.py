"""Scores of several runs: table, mean and spread, comparison, bounds."""

import json

import numpy as np
import pytest
from push_bag.commands.score import main


@pytest.fixture(scope='module')
def runs(record_once):
    """Three runs at 1, 2 and 4 mm from their reference."""

    def off(shift):
        return lambda pose, _time: pose + np.array([shift, 0.0, 0.0])

    return [str(record_once(displaced=off(shift), duration=0.4)) for shift in (1e-3, 2e-3, 4e-3)]


def test_several_runs_have_a_mean_and_a_sample_standard_deviation(runs, capsys):
    assert main([*runs, '--json']) == 0
    found = json.loads(capsys.readouterr().out)
    assert [run['run'] for run in found['runs']] == runs
    assert found['mean']['tracking_error_mm.mean'] == pytest.approx(7 / 3)
    assert found['spread']['tracking_error_mm.mean'] == pytest.approx(np.std([1, 2, 4], ddof=1))


def test_the_table_has_a_line_for_each_run_and_two_for_all(runs, capsys):
    assert main(runs) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == ['run', *runs, 'mean', 'spread']
    assert lines[-2].split()[1:5] == ['3', 'of', '3', '2.33']


def test_two_runs_are_compared_figure_by_figure(runs, capsys):
    assert main([*runs[1:], '--compare']) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert ['tracking_error_mm.mean', '2', '4', '2'] in lines


def test_a_figure_above_its_bound_is_one_line_and_status_1(runs, capsys):
    assert main([*runs, '--fail-above', 'mean=2.5', '--fail-above', 'lost=0']) == 1
    captured = capsys.readouterr()
    assert captured.err.count('\n') == 1
    assert f'tracking_error_mm.mean is 4 in {runs[2]}, above 2.5' in captured.err
    assert main([runs[0], '--fail-above', 'mean=1.1']) == 0


def test_a_figure_that_a_run_has_not_is_above_every_bound(record, capsys):
    run = str(record(facts={'mode': 'inprocess'}, duration=0.4))
    assert main([run, '--fail-above', 'pose_to_command_ms.p50=1000']) == 1
    assert f'{run} has no pose_to_command_ms.p50' in capsys.readouterr().err


def test_a_bound_on_incomplete_refuses_a_run_that_was_not_completed(runs, record, capsys):
    assert main([runs[0], '--fail-above', 'incomplete=0']) == 0
    stopped = str(record(end_reason='a node died', modes=lambda _tick: 2, duration=0.4))
    assert main([stopped, '--fail-above', 'incomplete=0']) == 1


@pytest.mark.parametrize(
    'words',
    [
        ['--fail-above', 'mean'],
        ['--fail-above', 'nonsense=1'],
        ['--fail-above', 'track=1'],
        ['--fail-above', 'stop_reason=1'],
    ],
)
def test_a_wrong_bound_is_one_line_and_status_2(runs, capsys, words):
    assert main([runs[0], *words]) == 2
    assert capsys.readouterr().err.count('\n') == 1


def test_a_comparison_takes_two_runs(runs):
    assert main([*runs, '--compare']) == 2


def test_an_error_names_its_bag(runs, record, capsys):
    broken = str(record(missing={'nominal_trajectory': {0}}))
    assert main([*runs, broken]) == 2
    assert f'{broken}: the bag holds no nominal trajectory' in capsys.readouterr().err


def test_several_runs_share_a_report(runs, tmp_path):
    assert main([*runs[:2], '--html', str(tmp_path / 'report.html')]) == 0
    assert '2 runs' in (tmp_path / 'report.html').read_text()
