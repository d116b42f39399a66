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
    assert data.missing == ('square_4mm_pushes*.csv', 'square_50mm_pushes*.csv')
    assert [run.name for run in data.runs] == ['run.csv']
