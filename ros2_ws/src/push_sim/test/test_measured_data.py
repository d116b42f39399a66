"""The reader of a folder of measurements."""

from pathlib import Path

import pytest
from push_core.common.errors import InputError
from push_core.data.robot_run import COLUMNS
from push_sim.measured.measured_data import read_measured_data


def test_a_folder_says_what_it_lacks_and_an_empty_one_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='holds none of'):
        read_measured_data(tmp_path)
    with pytest.raises(InputError, match='is no folder'):
        read_measured_data(tmp_path / 'nowhere')
    (tmp_path / 'robot_runs').mkdir()
    rows = [f'{0.01 * row:.2f},0.2,0,0.1,0,0,{0.001 * row:.3f},0' for row in range(150)]
    text = '\n'.join([','.join(COLUMNS), *rows])
    (tmp_path / 'robot_runs' / 'run.csv').write_text(text)
    data = read_measured_data(tmp_path)
    assert data.missing == ('short pushes', 'long pushes')
    assert [run.name for run in data.runs] == ['run.csv']


RUN = '\n'.join(
    [
        ','.join(COLUMNS),
        *(f'{0.01 * row:.2f},0.2,0,0.1,0,0,{0.001 * row:.3f},0' for row in range(150)),
    ]
)
PUSHES = (
    'p_y_m,beta_rad,dx_m,dy_m,dtheta_rad,distance_m\n'
    '0.0,1.5708,0.004,0.0,0.0,0.004\n0.01,1.5708,0.0035,0.0,0.03,0.004\n'
)


@pytest.mark.parametrize(
    'names',
    [
        ('square_4mm_pushes.csv', 'robot_runs/run.csv'),
        ('Monday.CSV', 'a run.txt'),
        ('2024/pushes/one.tsv', '2024/runs/deep/two.csv'),
        ('robot_runs/pushes.csv', 'square_4mm_pushes_2.csv'),
    ],
)
def test_files_are_known_by_their_columns_whatever_they_are_called(names, tmp_path) -> None:
    for name, text in zip(names, (PUSHES, RUN), strict=True):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text.replace(',', '\t') if name.endswith('tsv') else text)
    data = read_measured_data(tmp_path)
    assert len(data.short) == 2
    assert [run.name for run in data.runs] == [Path(names[1]).name]
    assert data.left_out == {}


def test_files_that_are_left_out_are_named_with_the_reason(tmp_path) -> None:
    (tmp_path / 'pushes.csv').write_text(PUSHES)
    (tmp_path / 'zz copy of pushes.csv').write_text(PUSHES)
    (tmp_path / 'README.md').write_text('# Data\n')
    (tmp_path / 'old.csv').write_text(PUSHES.replace('dtheta_rad', 'dtheta'))
    (tmp_path / 'track.csv').write_text('x,y\n0,0\n')
    (tmp_path / 'empty.csv').write_text('')
    (tmp_path / 'photo.csv').write_bytes(b'\x89PNG\xff')
    (tmp_path / '.hidden.csv').write_text('x')
    left_out = read_measured_data(tmp_path).left_out
    assert set(left_out) == {
        *('zz copy of pushes.csv', 'README.md', 'old.csv', 'track.csv', 'empty.csv'),
        'photo.csv',
    }
    assert left_out['zz copy of pushes.csv'] == 'is a copy of pushes.csv'
    assert left_out['README.md'].startswith('is no table')
    assert left_out['old.csv'] == 'lacks dtheta_rad of short pushes'
    assert left_out['track.csv'] == 'names no columns of pushes or robot runs'
    assert left_out['photo.csv'].startswith('is not a CSV text file')


def test_a_folder_of_other_files_says_what_they_are(tmp_path) -> None:
    (tmp_path / 'old.csv').write_text(PUSHES.replace('dtheta_rad', 'dtheta'))
    with pytest.raises(InputError, match=r'; old.csv lacks dtheta_rad of short pushes'):
        read_measured_data(tmp_path)


def test_pushes_of_two_distances_do_not_mix(tmp_path) -> None:
    (tmp_path / 'a.csv').write_text(PUSHES)
    (tmp_path / 'b.csv').write_text(PUSHES.replace('0.004\n', '0.005\n'))
    with pytest.raises(InputError, match=r'b.csv: pushes of 5 mm, but of 4 mm in .*a.csv'):
        read_measured_data(tmp_path)
