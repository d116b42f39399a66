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
