import json
from dataclasses import replace
from pathlib import Path

import pytest
from push_core.data.long_push_csv import COLUMNS as LONG_COLUMNS
from push_core.data.push_csv import write_pushes
from push_core.data.push_set import PushSet
from push_gp.commands import curve, evaluate, train
from push_gp.models.model_file import load_model

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
        (['pushes.csv', '-o', 'm.npz', '--pick', 'die', '--seed', '1'], 'need a random choice'),
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
    assert 'predicts pushes of 4 mm, these are of 5 mm' in capsys.readouterr().err


def test_evaluate_refuses_a_file_of_pushes_as_a_model(data: Path, capsys: Capture) -> None:
    assert evaluate.main([str(data), str(data)]) == 2
    assert 'no model file' in capsys.readouterr().err


@pytest.fixture
def long_data(tmp_path: Path) -> Path:
    """Two pushes along the inward normal: through the centre, and off the end of the face."""
    rows = ['0,0,0,0.05,0,0,-0.04975,0,0.00025,0', '0,0,0,0.03,-0.03,1,-0.04975,0.03,0.00025,0.03']
    (tmp_path / 'long.csv').write_text('\n'.join([','.join(LONG_COLUMNS), *rows]) + '\n')
    return tmp_path / 'long.csv'


def test_evaluate_rolls_a_model_out_along_long_pushes(long_data: Path, capsys: Capture) -> None:
    assert evaluate.main(['analytical', str(long_data), '--json']) == 0
    told = json.loads(capsys.readouterr().out)
    assert told['n'] == 2
    assert told['rollout']['on_face']['n'] == 1
    assert told['rollout']['on_face']['mean_mm'] < 1e-6
    assert told['rollout']['all']['mean_deg'] > 1.0


@pytest.mark.parametrize('which', ['short', 'long'])
def test_evaluate_draws_a_page_that_needs_no_server(
    data: Path, long_data: Path, which: str
) -> None:
    page = data.parent / 'page.html'
    pushes = data if which == 'short' else long_data
    assert evaluate.main([str(trained(data)), str(pushes), '--html', str(page)]) == 0
    text = page.read_text(encoding='utf-8')
    assert '<script src=' not in text
    assert text.count('class="figure"') == (7 if which == 'short' else 2)
    assert len(text) < 2_000_000


def test_curve_says_how_the_error_falls_with_the_pushes(data: Path, capsys: Capture) -> None:
    page = data.parent / 'curve.html'
    options = ['--seeds', '2', '--points', '5', '30', '--html', str(page), '--json']
    assert curve.main([str(data), *options]) == 0
    points = json.loads(capsys.readouterr().out)['points']
    assert [(point['n'], point['method']) for point in points] == [
        (size, method) for size in (5, 30) for method in ('zero', 'analytical', 'limit_surface')
    ]
    median = {
        (point['n'], point['method']): point['nmse_push_frame']['median'] for point in points
    }
    assert median[30, 'zero'] < 0.5 * median[5, 'zero']
    assert all(len(point['nmse_push_frame']['seeds']) == 2 for point in points)
    assert 'GP over the fitted motion cone' in page.read_text(encoding='utf-8')


@pytest.mark.parametrize(
    ('options', 'fault'),
    [
        (['--seeds', '0'], 'at least 1'),
        (['--points', '60'], 'allow 1 to'),
        (['--points', '5', '500'], 'cannot train on 500'),
        (['--html', 'none/page.html'], 'there is no folder none'),
    ],
)
def test_a_wrong_curve_command_is_one_line_and_status_2(
    options: list[str], fault: str, data: Path, capsys: Capture
) -> None:
    assert curve.main([str(data), *options]) == 2
    shown = capsys.readouterr().err
    assert fault in shown
    assert shown.count('\n') == 1


def test_copies_of_rows_count_once_and_are_named(
    pushes: PushSet, data: Path, capsys: Capture
) -> None:
    alone = load_model(trained(data)).info
    write_pushes(data, pushes.joined(pushes))
    capsys.readouterr()
    assert load_model(trained(data)).info.model_id == alone.model_id
    assert f'{len(pushes)} of {2 * len(pushes)} rows are copies' in capsys.readouterr().err


@pytest.mark.parametrize('command', ['train', 'evaluate', 'curve'])
def test_pushes_that_contradict_physics_are_refused_but_by_force(
    pushes: PushSet, data: Path, capsys: Capture, command: str
) -> None:
    model = trained(data, '--points', '20')
    write_pushes(data, replace(pushes, displacement=pushes.displacement * [1.0, 1.0, -1.0]))
    capsys.readouterr()
    run = {
        'train': lambda *more: train.main([str(data), '-o', str(model), *more]),
        'evaluate': lambda *more: evaluate.main([str(model), str(data), *more]),
        'curve': lambda *more: curve.main(
            [str(data), '--points', '5', '--seeds', '1', '--json', *more]
        ),
    }[command]
    assert run() == 2
    error = capsys.readouterr().err
    assert 'dtheta_rad has the other sign' in error
    assert len(error.splitlines()) == 1
    assert run('--force') == 0
    assert 'warning: ' in capsys.readouterr().err


def test_a_set_too_large_for_an_exact_process_is_thinned_with_a_word(
    data: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(train, 'MOST', 50)
    monkeypatch.setattr(train, 'THINNED', 20)
    monkeypatch.setattr(train, 'LARGEST', 55)
    path = trained(data)
    assert load_model(path).info.points == 20
    assert '60 pushes are many' in capsys.readouterr().err
    assert load_model(trained(data, '--points', '52')).info.points == 52
    assert train.main([str(data), '-o', str(path), '--points', '60']) == 2
