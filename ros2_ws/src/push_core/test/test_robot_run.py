"""The reader of robot runs."""

from pathlib import Path

import numpy as np
import pytest
from push_core.common.errors import InputError
from push_core.data.robot_run import COLUMNS, read_robot_run

HEADER = ','.join(COLUMNS)
ROWS = [
    f'{0.01 * row:.2f},0.2,0,0.1,{0.001 * row:.3f},0,{0.001 * row:.3f},0' for row in range(150)
]


def written(folder: Path, rows: list[str], header: str = HEADER) -> Path:
    path = folder / 'run.csv'
    path.write_text('\n'.join([header, *rows]) + '\n')
    return path


def test_a_run_is_read_with_time_from_zero_and_an_angle_without_jumps(tmp_path: Path) -> None:
    rows = [
        f'{5.0 + 0.01 * row},0,0,{3.1 if row < 70 else -3.1},0,0,{0.001 * row},0'
        for row in range(150)
    ]
    run = read_robot_run(written(tmp_path, rows))
    assert run.time[0] == 0.0
    assert run.time[-1] == pytest.approx(1.49)
    assert np.abs(np.diff(run.pose[:, 2])).max() < 0.1


def test_what_follows_a_robot_that_stopped_by_itself_does_not_count(tmp_path: Path) -> None:
    rows = [f'{0.01 * row},0,0,0,{0.001 * row},0,{0.001 * min(row, 80)},0' for row in range(150)]
    assert read_robot_run(written(tmp_path, rows)).following == 80


@pytest.mark.parametrize(
    ('row', 'text', 'fault'),
    [
        (30, '0.30,0.2,0,0.1,0.03,0,0.03', 'line 32: has 7 values, not 8'),
        (30, '0.30,0.2,0,nan,0.03,0,0.03,0', 'line 32: slider_theta_rad is nan'),
        (30, '0.29,0.2,0,0.1,0.03,0,0.03,0', 'line 32: t_s does not rise'),
        (149, '9.00,0.2,0,0.1,0.03,0,0.03,0', 'line 151: more than 0.2 s are missing'),
        (30, '0.30,200,0,0.1,0.03,0,0.03,0', 'line 32: a position is beyond 10 m'),
        (30, '0.30,0.2,0,57,0.03,0,0.03,0', 'line 32: slider_theta_rad is beyond 2 pi'),
    ],
)
def test_a_faulty_row_is_refused_with_its_line(
    row: int, text: str, fault: str, tmp_path: Path
) -> None:
    rows = [*ROWS[:row], text, *ROWS[row + 1 :]]
    with pytest.raises(InputError) as caught:
        read_robot_run(written(tmp_path, rows))
    assert f'{tmp_path / "run.csv"}' in str(caught.value)
    assert fault in str(caught.value)


def test_a_run_too_short_or_without_motion_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='lasts less than 1 s'):
        read_robot_run(written(tmp_path, ROWS[:50]))
    still = [f'{0.01 * row},0.2,0,0.1,{0.001 * row},0,0,0' for row in range(150)]
    with pytest.raises(InputError, match='the tip does not move'):
        read_robot_run(written(tmp_path, still))


def test_a_column_that_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='line 1: column pusher_cmd_x_m is missing'):
        read_robot_run(written(tmp_path, ROWS, HEADER.replace('pusher_cmd_x_m', 'x')))
