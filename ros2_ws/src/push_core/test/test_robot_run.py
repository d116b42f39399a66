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


def pushed(heading: float = 0.05, rows: int = 150) -> np.ndarray:
    """Rows (n, 8) of a push along x at 50 mm/s, the object turning by a heading to and fro."""
    time = 0.01 * np.arange(rows)
    theta = heading * np.sin(4.0 * time)
    x, zero = 0.05 * time, np.zeros(rows)
    tip_x, tip_y = x - 0.04975 * np.cos(theta), -0.04975 * np.sin(theta)
    return np.column_stack([time, x, zero, theta, tip_x, tip_y, tip_x, tip_y])


def saved(folder: Path, rows: np.ndarray) -> Path:
    return written(folder, [','.join(f'{value:.17g}' for value in row) for row in rows])


LENGTHS = [1, 2, 4, 5, 6, 7]


@pytest.mark.parametrize(
    ('columns', 'factor', 'offset', 'fault'),
    [
        ([0], 1e3, 0.0, 'line 3: t_s rises by 10 from row to row, as in milliseconds'),
        ([0], 1e3, 1.7e12, 'line 3: t_s rises by 10 from row to row, as in milliseconds'),
        ([0], 1e6, 0.0, 'as in microseconds'),
        ([0], 1e9, 1.7e18, 'as in nanoseconds; seconds are expected'),
        (LENGTHS, 1e3, 0.0, 'line 2: a position is beyond 10 m; metres are expected'),
        (LENGTHS, 1e2, 0.0, "closer than 4.97 m to the object's centre, as in centimetres"),
        (LENGTHS, 39.37, 0.0, "closer than 1.96 m to the object's centre"),
        ([3], 57.3, 0.0, 'slider_theta_rad looks like degrees; radians are expected'),
        ([3], -1.0, 0.0, 'slider_theta_rad has the other sense'),
    ],
)
def test_other_units_and_signs_are_named(
    columns: list[int], factor: float, offset: float, fault: str, tmp_path: Path
) -> None:
    rows = pushed(heading=0.4 if factor < 0.0 else 0.05)
    rows[:, columns] = rows[:, columns] * factor + offset
    with pytest.raises(InputError) as caught:
        read_robot_run(saved(tmp_path, rows))
    assert fault in str(caught.value)


@pytest.mark.parametrize('turn', [0.0, 0.5, 1.571, 3.1, -2.0])
def test_a_push_in_any_direction_is_read(turn: float, tmp_path: Path) -> None:
    rows = pushed()
    cos, sin = np.cos(turn), np.sin(turn)
    for x in (1, 4, 6):
        rows[:, x : x + 2] = rows[:, x : x + 2] @ np.array([[cos, sin], [-sin, cos]])
    rows[:, 3] += turn
    assert read_robot_run(saved(tmp_path, rows)).pose.shape == (150, 3)


def test_seconds_since_1970_are_seconds(tmp_path: Path) -> None:
    rows = pushed()
    rows[:, 0] += 1.7e9
    run = read_robot_run(saved(tmp_path, rows))
    assert run.time[[0, -1]] == pytest.approx([0.0, 1.49], abs=1e-6)


def test_a_single_row_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='line 2: is the only row'):
        read_robot_run(written(tmp_path, ROWS[:1]))


def test_a_time_that_comes_twice_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='line 32: t_s does not rise'):
        read_robot_run(written(tmp_path, [*ROWS[:30], ROWS[29], *ROWS[30:]]))
