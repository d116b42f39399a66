import json
from pathlib import Path

import pytest
from push_core.push_csv import write_pushes
from push_core.push_set import PushSet
from push_gp import evaluate, train
from push_gp.model_file import load_model

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def data(pushes: PushSet, tmp_path: Path) -> Path:
    write_pushes(tmp_path / 'pushes.csv', pushes)
    return tmp_path / 'pushes.csv'


def trained(data: Path, *options: str) -> Path:
    path = data.parent / 'model.npz'
    assert train.main([str(data), '-o', str(path), *options]) == 0
    return path


def test_train_writes_a_model_and_one_screen(data: Path, capsys: Capture) -> None:
    path = trained(data, '--points', '30', '--seed', '1')
    shown = capsys.readouterr()
    assert load_model(path).info.points == 30
    assert 'on the other 30 pushes: rmse' in shown.out
    assert load_model(path).info.model_id in shown.out
    assert len(shown.out.splitlines()) < 25
    assert shown.err == ''


def test_the_same_command_writes_the_same_file(data: Path) -> None:
    first = trained(data, '--points', '30').read_bytes()
    assert trained(data, '--points', '30').read_bytes() == first
    assert trained(data, '--points', '30', '--seed', '1').read_bytes() != first


def test_train_picks_the_five_of_a_die_and_learns_over_the_cone(data: Path) -> None:
    info = load_model(trained(data, '--pick', 'die', '--mean', 'analytical')).info
    assert info.points == 5
    assert info.mean_function == 'analytical'


def test_evaluate_writes_the_block_of_accuracy_figures(data: Path, capsys: Capture) -> None:
    path = trained(data, '--points', '40')
    capsys.readouterr()
    assert evaluate.main([str(path), str(data), '--json']) == 0
    block = json.loads(capsys.readouterr().out)
    assert block['n'] == 60
    assert set(block['rmse']) == {'dx_mm', 'dy_mm', 'dtheta_deg'}
    for frame in ('nmse_push_frame', 'nmse_body_frame'):
        assert set(block[frame]) == {'dx', 'dy', 'dtheta', 'mean'}
    assert set(block['nlpd']) == set(block['coverage_95']) == {'dx', 'dy', 'dtheta'}
    assert block['trained_on'] == 40


def test_evaluate_says_in_words_what_it_found(data: Path, capsys: Capture) -> None:
    path = trained(data, '--points', '40')
    capsys.readouterr()
    assert evaluate.main([str(path), str(data)]) == 0
    shown = capsys.readouterr().out
    assert 'NMSE, push frame' in shown
    assert 'note: 40 of these pushes are in the training set' in shown


def test_evaluate_takes_the_motion_cone_as_a_model(data: Path, capsys: Capture) -> None:
    assert evaluate.main(['analytical', str(data), '--json']) == 0
    block = json.loads(capsys.readouterr().out)
    assert block['nlpd'] is None
    assert block['nmse_push_frame']['mean'] < 0.05


@pytest.mark.parametrize(
    ('options', 'fault'),
    [
        (['none.csv', '-o', 'm.npz'], 'No such file'),
        (['pushes.csv', '-o', 'm.npz', '--points', '61'], 'cannot choose 61 of 60 pushes'),
        (['pushes.csv', '-o', 'm.npz', '--points', '0'], 'cannot choose 0 of 60 pushes'),
        (['pushes.csv', '-o', 'm.npz', '--seed', '-1'], 'must not be negative'),
        (['pushes.csv', '-o', 'm.npz', '--subset', 'subset_1'], 'there is no subset'),
        (['pushes.csv', '-o', 'none/m.npz'], 'there is no folder none'),
        (['pushes.csv', '-o', '.'], 'it is a folder'),
    ],
)
def test_a_wrong_train_command_is_one_line_and_status_2(
    options: list[str], fault: str, data: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(data.parent)
    assert train.main(options) == 2
    shown = capsys.readouterr()
    assert fault in shown.err
    assert shown.err.count('\n') == 1
    assert shown.out == ''
    assert [path.name for path in data.parent.iterdir()] == ['pushes.csv']


def test_evaluate_refuses_pushes_of_another_distance(
    data: Path, pushes: PushSet, capsys: Capture
) -> None:
    other = data.parent / 'other.csv'
    write_pushes(other, PushSet(pushes.p_y, pushes.beta, pushes.displacement, 0.005))
    assert evaluate.main(['analytical', str(other)]) == 2
    assert 'answers for pushes of 4 mm, these are of 5 mm' in capsys.readouterr().err


def test_evaluate_refuses_a_file_of_pushes_as_a_model(data: Path, capsys: Capture) -> None:
    assert evaluate.main([str(data), str(data)]) == 2
    assert 'no model file' in capsys.readouterr().err
