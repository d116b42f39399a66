"""`validate` on measurements of a plant that is known, and its command line."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from push_core.physics.actuator import ActuatorSettings
from push_sim.commands.validate import main
from push_sim.fitting.actuator_fit import fit_actuator
from push_sim.measured.measured_data import read_measured_data
from push_sim.measured.tip_replay import rms_coordinate, tip_error
from push_sim.settings.profiles import profile

ACTUATOR = replace(profile('irb120').actuator, dead_time=0.0713, lag=0.0334)
PLANT = replace(profile('ideal'), actuator=ACTUATOR)


@pytest.fixture(scope='module')
def folder(measure_artificially, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return measure_artificially(tmp_path_factory.mktemp('data'), PLANT)


@pytest.fixture(scope='module')
def figures(folder: Path) -> dict:
    """What the command prints, once for all tests."""
    with pytest.MonkeyPatch.context() as patch:
        written: list[str] = []
        patch.setattr('sys.stdout.write', written.append)
        assert main(['--data', str(folder), '--json', '--jobs', '1']) == 0
    return json.loads(''.join(written))


def test_a_simulator_that_made_the_pushes_repeats_them(figures: dict) -> None:
    assert figures['pushes_4mm']['n'] == 48
    assert figures['pushes_4mm']['nmse_push_frame']['mean'] < 1e-3
    assert 1e-3 < figures['pushes_4mm']['limit_surface']['nmse_push_frame']['mean'] < 0.1
    (long,) = figures['pushes_50mm']
    assert long['file'] == 'square_50mm_pushes_artificial.csv'
    assert long['on_face']['n'] == long['all']['n'] == 6
    assert long['all']['mean_mm'] < 0.1
    assert long['limit_surface']['all']['mean_mm'] > 0.01
    (run,) = figures['robot_runs']
    assert run['slider_rms_mm'] < 0.01
    assert run['windows'] == 6


def test_the_lag_of_a_run_is_identified_within_a_millisecond(figures: dict) -> None:
    (run,) = figures['robot_runs']
    plant = profile('irb120').actuator
    assert (run['dead_time_s'], run['lag_s']) == (plant.dead_time, plant.lag)
    assert run['identified']['dead_time_s'] == pytest.approx(ACTUATOR.dead_time, abs=1e-3)
    assert run['identified']['lag_s'] == pytest.approx(ACTUATOR.lag, abs=1e-3)
    assert run['identified']['tip_rms_mm'] < 1e-3 < run['tip_rms_mm']
    assert run['tip_distance_rms_mm'] == pytest.approx(run['tip_rms_mm'] * np.sqrt(2.0))


def test_the_fit_of_the_lag_does_not_depend_on_where_it_starts(folder: Path) -> None:
    (run,) = read_measured_data(folder).runs
    for dead_time, lag in ((0.0, 0.0), (0.15, 0.01)):
        found = fit_actuator(run, ActuatorSettings(dead_time=dead_time, lag=lag))
        assert rms_coordinate(tip_error(run, found.settings)) < 1e-5


def test_table_and_page_show_every_part_and_say_what_is_missing(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source = folder / 'robot_runs' / 'weave.csv'
    (tmp_path / 'robot_runs').mkdir()
    (tmp_path / 'robot_runs' / 'weave.csv').write_bytes(source.read_bytes())
    page = tmp_path / 'page.html'
    assert main(['--data', str(tmp_path), '--jobs', '1', '--html', str(page)]) == 0
    shown = capsys.readouterr().out
    assert 'src="http' not in page.read_text()
    assert page.read_text().count('class="figure"') == 3
    assert 'weave.csv' in shown
    assert 'dead time 71.3 ms, lag 33.4 ms' in shown
    assert 'no short pushes: no file has the columns p_y_m, beta_rad, dx_m' in shown
    assert 'no long pushes' in shown


def test_a_wrong_command_is_one_line_and_status_2(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    faulty = tmp_path / 'square_4mm_pushes.csv'
    lines = (folder / 'square_4mm_pushes.csv').read_text().splitlines()
    faulty.write_text('\n'.join([*lines[:3], 'a' + lines[3], *lines[4:]]))
    for arguments, named in (
        ([str(tmp_path)], f'{faulty}, line 4'),
        ([str(tmp_path / 'nowhere')], 'is no folder'),
        ([str(folder), '--jobs', '0'], '--jobs is 0'),
    ):
        assert main(['--data', *arguments]) == 2
        error = capsys.readouterr().err
        assert named in error
        assert error.count('\n') == 1
