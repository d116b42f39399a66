"""A run of the real cell is imported as a bag that can be scored and reported."""

import os
from pathlib import Path

import numpy as np
import pytest
from push_bag.commands.import_csv import main
from push_bag.commands.score import main as score
from push_bag.run.run_reader import read_run
from push_bag.score.score import score_run
from push_core.data.robot_run import COLUMNS

DATA = Path(os.environ.get('PUSH_DATA_DIR') or Path(__file__).resolve().parents[5] / 'shared/data')
MEASURED = DATA / 'robot_runs' / 'line_50mms_unperturbed.csv'


@pytest.fixture
def written(tmp_path):
    """Writes rows (n, 8) as a run's CSV file."""

    def write(rows):
        path = tmp_path / 'made_up.csv'
        np.savetxt(path, rows, '%.9g', ',', header=','.join(COLUMNS), comments='')
        return path

    return write


def straight(offset):
    """One second at 50 mm/s along x, the object at an offset; rows at uneven times."""
    time = np.linspace(0.0, 1.0, 501) ** 1.1
    x = 0.05 * time
    zero = np.zeros_like(time)
    tip = x - 0.045 - 0.00475
    return np.stack([time, x, zero + offset, zero, tip, zero + offset, tip, zero + offset], axis=1)


def test_the_offset_from_the_line_is_the_score(written, tmp_path):
    assert main([str(written(straight(0.002))), '-o', str(tmp_path / 'run')]) == 0
    found = score_run(tmp_path / 'run')
    assert found['completed'] is True
    assert found['cross_track_mm'] == pytest.approx({'mean': 2.0, 'rms': 2.0, 'max': 2.0})
    assert found['tracking_error_mm']['mean'] == pytest.approx(2.0, abs=1e-3)
    assert found['speed_m_s'] == pytest.approx(0.05)
    assert found['solve_ms']['p50'] is None
    assert found['pose_to_command_ms']['p50'] is None


def test_a_run_without_measured_times_has_a_report(written, tmp_path):
    assert main([str(written(straight(0.002))), '-o', str(tmp_path / 'run')]) == 0
    assert score([str(tmp_path / 'run'), '--html', str(tmp_path / 'page.html')]) == 0
    assert 'not measured' in (tmp_path / 'page.html').read_text()


def test_commands_are_the_slopes_of_the_commanded_positions(written, tmp_path):
    assert main([str(written(straight(0.0))), '-o', str(tmp_path / 'run')]) == 0
    run = read_run(tmp_path / 'run')
    np.testing.assert_allclose(run.commands.values[10:-10, 0], 0.05, rtol=1e-5)
    assert run.object.stamp.size == 501


@pytest.mark.skipif(not MEASURED.is_file(), reason='the measured runs are not there')
def test_the_unperturbed_run_of_the_robot_has_the_published_lateral_error(tmp_path):
    assert main([str(MEASURED), '-o', str(tmp_path / 'run')]) == 0
    figures = score_run(tmp_path / 'run')['cross_track_mm']
    assert figures['rms'] == pytest.approx(1.7, abs=0.05)


def test_a_file_of_another_kind_is_one_line_and_makes_no_folder(written, tmp_path, capsys):
    backwards = straight(0.0)[::-1]
    other = tmp_path / 'other.csv'
    other.write_text('a,b\n1,2\n')
    for path in (written(backwards), other, tmp_path / 'none.csv'):
        assert main([str(path), '-o', str(tmp_path / 'run')]) == 2
        assert capsys.readouterr().err.count('\n') == 1
        assert not (tmp_path / 'run').exists()


def turned(rows, angle):
    """The run, turned about the origin."""
    rows = rows.copy()
    cos, sin = np.cos(angle), np.sin(angle)
    for x in (1, 4, 6):
        rows[:, x : x + 2] = rows[:, x : x + 2] @ np.array([[cos, sin], [-sin, cos]])
    rows[:, 3] += angle
    return rows


def waving(amplitude):
    """Two periods of a wave about the x axis, so that the fitted line is the axis."""
    rows = straight(0.0)
    rows[:, 2] = amplitude * np.cos(4 * np.pi * rows[:, 0])
    rows[:, [5, 7]] = rows[:, [2]]
    return rows


@pytest.mark.parametrize('degrees', [30.0, 90.0, 180.0, -90.0, -170.0, 8.0])
def test_a_line_in_any_direction_is_fitted(written, tmp_path, capsys, degrees):
    path = written(turned(waving(0.001), np.radians(degrees)))
    assert main([str(path), '-o', str(tmp_path / 'run')]) == 0
    assert 'the reference is a line at ' in capsys.readouterr().out
    found = score_run(tmp_path / 'run')
    assert found['completed'] is True
    assert found['cross_track_mm']['max'] == pytest.approx(1.0, abs=0.1)
    assert found['tracking_error_mm']['rms'] == pytest.approx(0.5**0.5, rel=0.05)
    assert found['heading_error_deg']['max'] < 0.3


def test_a_line_beside_the_x_axis_is_fitted(written, tmp_path):
    assert main([str(written(straight(0.3))), '-o', str(tmp_path / 'run')]) == 0
    found = score_run(tmp_path / 'run')
    assert found['cross_track_mm']['max'] == pytest.approx(0.0, abs=1e-6)
    assert read_run(tmp_path / 'run').facts['reference'].startswith('a line at 0.0 deg')


@pytest.mark.parametrize(
    ('gap', 'lost'), [((200, 270), 70), ((200, 201), 1), (slice(5, 501, 10), 50)]
)
def test_rows_that_are_missing_are_lost_messages(written, tmp_path, gap, lost):
    rows = straight(0.0)
    rows[:, 0] = 0.0025 * np.arange(501)
    left = np.delete(rows, gap if isinstance(gap, slice) else slice(*gap), axis=0)
    assert main([str(written(left)), '-o', str(tmp_path / 'run')]) == 0
    counts = score_run(tmp_path / 'run')['messages']['/object_pose']
    assert (counts['received'], counts['lost']) == (len(left), lost)


@pytest.mark.skipif(not MEASURED.is_file(), reason='the measured runs are not there')
def test_the_uneven_rows_of_the_robot_are_not_called_lost(tmp_path):
    assert main([str(MEASURED), '-o', str(tmp_path / 'run')]) == 0
    assert score_run(tmp_path / 'run')['messages']['/object_pose']['lost'] == 0


def held(rows, columns):
    rows[:, columns] = rows[0, columns]
    return rows


def circling(_rows):
    rows = straight(0.0)
    angle = 6.0 * rows[:, 0]
    rows[:, 1], rows[:, 2] = 0.1 * np.sin(angle), 0.1 - 0.1 * np.cos(angle)
    rows[:, 3] = angle
    for x in (4, 6):
        rows[:, x] = rows[:, 1] - 0.04975 * np.cos(angle)
        rows[:, x + 1] = rows[:, 2] - 0.04975 * np.sin(angle)
    return rows


@pytest.mark.parametrize(
    ('spoil', 'reason'),
    [
        (lambda rows: held(rows, slice(1, 8)), 'the tip does not move'),
        (lambda rows: held(rows, slice(1, 4)), 'the object does not move'),
        (circling, 'does not follow a straight line'),
        (lambda rows: turned(rows, 1.5708) * [1, 1, 1, 0, 1, 1, 1, 1], 'not at its face'),
        (lambda rows: rows - [0, 0, 0, 0, 0.02, 0, 0.02, 0], 'give --side and --tip-radius'),
    ],
    ids=['still', 'not touched', 'on a circle', 'heading never measured', 'another size'],
)
def test_what_is_no_push_along_a_line_is_refused(written, tmp_path, capsys, spoil, reason):
    assert main([str(written(spoil(straight(0.0)))), '-o', str(tmp_path / 'run')]) == 2
    error = capsys.readouterr().err
    assert reason in error
    assert error.count('\n') == 1
    assert not (tmp_path / 'run').exists()


def test_an_object_of_another_size_is_imported_with_its_size(written, tmp_path):
    rows = straight(0.0) - [0, 0, 0, 0, 0.02, 0, 0.02, 0]
    assert main([str(written(rows)), '-o', str(tmp_path / 'run'), '--side', '0.13']) == 0
    assert score_run(tmp_path / 'run')['completed'] is True
