"""Bad input to `cell`: one clear line, status 2, nothing left behind."""

import pytest
from push_bringup.commands.cell import main


@pytest.fixture
def refused(model_file, tmp_path, capsys):
    """Runs the cell with bad arguments and gives its one line of error."""

    def run(*arguments, model=model_file):
        runs = tmp_path / 'runs'
        status = main(['--mode', 'inprocess', '--model', str(model), '-o', str(runs), *arguments])
        out, err = capsys.readouterr()
        assert status == 2
        assert out == ''
        assert not any(runs.glob('*'))
        (line,) = err.splitlines()
        return line

    return run


@pytest.mark.parametrize(
    ('arguments', 'said'),
    [
        (('--track', 'nine'), "unknown track 'nine'"),
        (('--track', 'none.csv'), 'none.csv: No such file'),
        (('--speed', '0'), 'must be above 0'),
        (('--speed', '-0.1'), 'must be above 0'),
        (('--speed', 'nan'), 'must be above 0'),
        (('--speed', '0.5'), 'the limit of the pusher'),
        (('--laps', '0'), 'laps is 0, must be between 1'),
        (('--track', 'line', '--laps', '2'), 'open and has no second lap'),
        (('--seed', '-1'), 'seed is -1'),
        (('-p', 'horizn_steps:=3'), "unknown parameter 'horizn_steps'"),
        (('-p', 'mpc_node.world.substep:=0.001'), "unknown parameter 'world.substep'"),
        (('-p', 'weights.contact:=-1'), 'weights.contact is -1, must be between 0'),
        (('-p', 'world.friction_ground:=-0.1'), 'friction_ground is -0.1, must be between'),
        (('-p', 'delay_compensation:=maybe'), 'takes bool'),
        (('-p', 'speed'), 'NAME:=VALUE'),
        (('--namespace', '!!'), 'letters, digits'),
    ],
)
def test_a_bad_argument_is_named(refused, arguments, said) -> None:
    assert said in refused(*arguments)


@pytest.mark.parametrize(
    ('content', 'said'),
    [
        ('', 'at least 4 points'),
        ('x,y\n0,0\n0.1,abc\n', 'track.csv:3'),
        ('0,0\n0.1,nan\n', 'track.csv:2'),
        ('0,0\n0,0\n0,0\n0,0\n', 'at least 4 points'),
    ],
)
def test_a_bad_track_is_named_with_its_place(refused, tmp_path, content, said) -> None:
    track = tmp_path / 'track.csv'
    track.write_text(content)
    assert said in refused('--track', str(track))


def test_a_missing_truncated_or_other_model_is_named(refused, model_file, tmp_path) -> None:
    cut, other = tmp_path / 'cut.npz', tmp_path / 'other.npz'
    cut.write_bytes(model_file.read_bytes()[:1000])
    other.write_text('p_y_m,beta_rad\n')
    assert 'none.npz: No such file' in refused(model=tmp_path / 'none.npz')
    assert 'cut.npz: is damaged or no model file' in refused(model=cut)
    assert 'other.npz: is damaged or no model file' in refused(model=other)


def test_an_output_that_is_a_file_is_named(refused, tmp_path) -> None:
    taken = tmp_path / 'taken'
    taken.write_text('mine')
    assert 'taken: File exists' in refused('-o', str(taken))
    assert taken.read_text() == 'mine'


def test_a_model_does_not_go_with_the_analytical_controller(refused) -> None:
    assert '--model is not for' in refused('--controller', 'analytical')
