"""A run in one process, through the command."""

import json
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import pytest
from mcap.reader import make_reader
from push_bringup.commands.cell import main
from push_bringup.comparison.qp_recording import lap_request
from push_bringup.graph.cell_lock import CellLock
from push_bringup.setup.run_folder import new_run_folder
from push_core.common.errors import RunError

LINE = ('--mode', 'inprocess', '--track', 'line', '--speed', '0.1')


@pytest.fixture(scope='module')
def folder(model_file, tmp_path_factory) -> Path:
    """Of a run that all tests read."""
    runs = tmp_path_factory.mktemp('line') / 'runs'
    assert main([*LINE, '--model', str(model_file), '-o', str(runs)]) == 0
    (folder,) = runs.iterdir()
    return folder


def test_a_run_leaves_a_folder_with_bag_score_and_report(folder) -> None:
    assert folder.name.endswith('_line_gp_100mms')
    names = {path.name for path in folder.iterdir()}
    assert names == {f'{folder.name}_0.mcap', 'metadata.yaml', 'score.json', 'report.html'}
    score = json.loads((folder / 'score.json').read_text())
    assert (score['completed'], score['mode'], score['seed']) == (True, 'inprocess', 0)


def test_two_runs_within_a_second_get_two_folders(tmp_path) -> None:
    request = replace(lap_request('gp', 'analytical', 0), output=tmp_path)
    now = datetime(2026, 11, 23, 12, 30, 59).astimezone()
    folders = []
    for _ in range(3):
        folders.append(new_run_folder(request, now))
        folders[-1].mkdir()
    name = '20261123-123059_eight_gp_80mms'
    assert [folder.name for folder in folders] == [name, f'{name}_2', f'{name}_3']


def test_a_run_that_does_not_reach_its_end_says_why_with_status_1(tmp_path, capsys) -> None:
    lost = ('-p', 'sim_node.actuator.dead_time:=0.6', '-p', 'consistent_plan:=false')
    arguments = [*LINE, '--controller', 'analytical', '--speed', '0.2', '--track', 'eight']
    assert main([*arguments, *lost, '-o', str(tmp_path)]) == 1
    out, err = capsys.readouterr()
    assert 'not completed' in err
    assert not json.loads((Path(out.splitlines()[-1]) / 'score.json').read_text())['completed']


def test_the_bag_holds_what_is_needed_to_repeat_the_run(model_file, folder) -> None:
    (path,) = folder.glob('*.mcap')
    with path.open('rb') as stream:
        reader = make_reader(stream)
        (facts,) = (record.metadata for record in reader.iter_metadata() if record.name == 'run')
        attached = {attachment.name: attachment.data for attachment in reader.iter_attachments()}
    assert facts['profile'] == 'irb120'
    assert set(json.loads(facts['versions'])) >= {'numpy', 'osqp', 'pybullet'}
    assert set(attached) == {'params.yaml', 'nominal_trajectory.csv', model_file.name}
    assert facts['training_set_hash']
    assert attached[model_file.name] == model_file.read_bytes()


def test_a_second_cell_of_the_same_name_is_refused() -> None:
    with CellLock('here'), CellLock('there'), pytest.raises(RunError, match='--namespace'):
        CellLock('here').__enter__()
    with CellLock('here'):
        pass
