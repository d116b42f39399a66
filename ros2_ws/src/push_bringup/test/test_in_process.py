"""A run in one process, through the command."""

import json
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from push_bag.replay.recompute import Changes, recomputed
from push_bag.run.run_reader import read_run
from push_bringup.commands.cell import main
from push_bringup.graph.cell_lock import CellLock
from push_bringup.setup.run_folder import new_run_folder
from push_core.common.errors import RunError
from push_mpc.settings import mpc_settings

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
    now = datetime(2026, 11, 23, 12, 30, 59).astimezone()
    folders = []
    for _ in range(3):
        folders.append(
            new_run_folder(tmp_path, replace(mpc_settings('ideal'), controller='gp'), now)
        )
        folders[-1].mkdir()
    name = '20261123-123059_eight_gp_80mms'
    assert [folder.name for folder in folders] == [name, f'{name}_2', f'{name}_3']


@pytest.mark.parametrize(
    ('track', 'speed', 'ending'),
    [
        ('square', 0.0125, 'square_gp_12.5mms'),
        ('Ma piste n° 1/oval (1).csv', 0.05, 'oval_1_gp_50mms'),
        ('Größe.csv', 0.05, 'Groe_gp_50mms'),
        ('線.csv', 0.05, 'track_gp_50mms'),
        ('a' * 300 + '.csv', 0.05, 'a' * 60 + '_gp_50mms'),
        ('$(id);&|<>*?.csv', 0.05, 'id_gp_50mms'),
    ],
)
def test_a_folder_name_is_of_plain_characters(track, speed, ending, tmp_path) -> None:
    mpc = replace(mpc_settings('ideal'), controller='gp', track=track, speed=speed)
    now = datetime(2026, 11, 23, 12, 30, 59).astimezone()
    assert new_run_folder(tmp_path, mpc, now).name == f'20261123-123059_{ending}'


@pytest.mark.parametrize('way', ['options', 'overrides', 'file'])
def test_label_facts_score_and_folder_tell_what_was_run_however_it_was_set(
    way, tmp_path, capsys
) -> None:
    chosen = {'track': 'line', 'speed': 0.1, 'controller': 'analytical', 'profile': 'ideal'}
    chosen |= {'seed': 7}
    arguments = ['--mode', 'inprocess', '-o', str(tmp_path / 'runs')]
    if way == 'file':
        path = tmp_path / 'mine.yaml'
        path.write_text(json.dumps({'/**': {'ros__parameters': chosen}}))
        arguments += ['--params', str(path)]
    for name, value in chosen.items():
        if way == 'options':
            arguments += [f'--{name}', str(value)]
        elif way == 'overrides':
            arguments += ['-p', f'{name}:={value}']
    assert main(arguments) == 0
    out = capsys.readouterr().out
    assert 'line, 100 mm/s, 1 lap, analytical, ideal, inprocess, seed 7\n' in out
    folder = Path(out.splitlines()[-1])
    assert folder.name.endswith('_line_analytical_100mms')
    score = json.loads((folder / 'score.json').read_text())
    assert (score['profile'], score['seed'], score['changed']) == ('ideal', 7, None)
    facts = read_run(folder).facts
    assert {name: facts[name] for name in chosen} == {
        name: str(value) for name, value in chosen.items()
    }


def test_changed_parameters_are_part_of_the_label(tmp_path, capsys) -> None:
    changed = ('-p', 'sim_node.actuator.lag:=0.02')
    assert main([*LINE, '--controller', 'analytical', *changed, '-o', str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert 'seed 0, sim_node.actuator.lag=0.02\n' in out
    report = (Path(out.splitlines()[-1]) / 'report.html').read_text()
    assert 'sim_node.actuator.lag=0.02' in report


def test_a_run_begins_where_the_object_lies_and_is_recomputed_bit_for_bit(
    model_file, tmp_path, capsys
) -> None:
    place = {'x': 0.05, 'y': -0.1, 'theta': 2.0, 'p_y': 0.01, 'gap': 0.02}
    words = [word for name, value in place.items() for word in ('-p', f'start.{name}:={value}')]
    chosen = [*LINE, '--start', 'here', '--model', str(model_file)]
    assert main([*chosen, *words, '-o', str(tmp_path)]) == 0
    folder = Path(capsys.readouterr().out.splitlines()[-1])
    run = read_run(folder)
    assert run.reference is not None
    begin, end = run.reference.pose[[0, -1]]
    np.testing.assert_array_equal(begin, run.object.values[0])
    assert begin == pytest.approx([0.05, -0.1, 2.0], abs=0.005)
    assert end[:2] - begin[:2] == pytest.approx(0.5 * np.array([np.cos(2), np.sin(2)]), abs=3e-3)
    score = json.loads((folder / 'score.json').read_text())
    assert score['tracking_error_mm']['mean_after_start'] < 1.0
    assert 'mpc_node.start_from=here' in score['changed']
    assert recomputed(folder, Changes()).same


def test_a_run_that_cannot_begin_where_the_object_lies_says_why(tmp_path, capsys) -> None:
    chosen = [*LINE, '--start', 'here', '--controller', 'analytical', '-o', str(tmp_path)]
    assert main([*chosen, '-p', 'start.gap:=0.2']) == 1
    assert 'the tip is not in front of the pushed face: 200 mm' in capsys.readouterr().err
    assert main([*chosen, '-p', 'start.x:=0.5']) == 1
    assert 'from here the track leaves the workspace' in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


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
