"""`calibrate` on measurements of a plant that is known, and its command line."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from push_core.common.workers import worker_pool
from push_core.physics.slider import Slider
from push_sim.calibration.calibration import PlantCalibration, calibrate_plant, rounded
from push_sim.calibration.output import calibration_json, calibration_table, ros_parameter_file
from push_sim.commands.calibrate import main
from push_sim.fitting.bootstrap import bootstrap_deviation
from push_sim.measured.measured_data import read_measured_data, split_measurements
from push_sim.settings.profiles import profile
from push_sim.settings.world_settings import WorldSettings

# the engine without inertia is as good a plant to be found again, and ten times faster
START = replace(profile('irb120'), world=WorldSettings(engine='quasi_static'))
TRUTH = replace(
    START,
    world=replace(START.world, friction_pusher=0.27, support_radius=0.0334),
    actuator=replace(START.actuator, dead_time=0.072, lag=0.033),
)


@pytest.fixture(scope='module')
def folder(measure_artificially, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return measure_artificially(tmp_path_factory.mktemp('data'), TRUTH)


@pytest.fixture(scope='module')
def found(folder: Path) -> PlantCalibration:
    with worker_pool(1) as pool:
        return calibrate_plant(read_measured_data(folder), START, Slider(), pool.in_order, seed=0)


def test_the_parameters_of_a_known_plant_are_found_within_their_uncertainty(found) -> None:
    by_name = {each.name: each for each in found.parameters}
    for name in ('friction_pusher', 'support_radius'):
        fitted = by_name[f'world.{name}']
        truth = getattr(TRUTH.world, name)
        assert fitted.deviation < 0.1 * truth
        assert abs(fitted.value - truth) < 3.0 * fitted.deviation
        assert fitted.before == getattr(START.world, name)
    assert found.settings.actuator.dead_time == pytest.approx(0.072, abs=1e-3)
    assert found.settings.actuator.lag == pytest.approx(0.033, abs=1e-3)


def test_what_was_not_fitted_stays(found: PlantCalibration) -> None:
    assert found.settings.sensor == START.sensor
    assert found.settings.world.stiffness == START.world.stiffness
    # this engine has no feet, so that their stiffness changes nothing
    assert found.world is not None
    assert found.world.stiffness_effect < 1e-12


def test_the_rest_is_told_as_well_as_the_part_that_was_fitted(found: PlantCalibration) -> None:
    figures = calibration_json(found, 0, 'abc')
    assert figures['fitted']['pushes_4mm']['n'] == figures['kept']['pushes_4mm']['n'] == 24
    for bar in figures['bars']:
        assert bar['fitted'] < bar['limit']
        assert bar['kept'] < bar['limit']
    shown = calibration_table(figures)
    assert 'world.support_radius' in shown
    assert 'do not identify it' in shown


def test_the_seed_alone_decides_which_pushes_are_fitted_and_none_is_in_both_parts(
    folder: Path,
) -> None:
    data = read_measured_data(folder)
    first, again, other = (split_measurements(data, seed) for seed in (0, 0, 1))
    assert first[0].short.sha256() == again[0].short.sha256() != other[0].short.sha256()
    p_y = np.concatenate([part.short.p_y for part in first])
    assert np.array_equal(np.sort(p_y), np.sort(data.short.p_y))
    assert [len(part.long['square_50mm_pushes_artificial.csv']) for part in first] == [3, 3]


def test_the_parameter_file_is_one_for_plant_and_controller(found: PlantCalibration) -> None:
    blocks = yaml.safe_load(ros_parameter_file(found.parameters, 'abc'))
    sim, mpc = (blocks[f'/**/{node}']['ros__parameters'] for node in ('sim_node', 'mpc_node'))
    assert sim['world.support_radius'] == found.settings.world.support_radius
    assert sim['actuator.lag'] == mpc['actuator.lag'] == found.settings.actuator.lag
    assert not [name for name in mpc if name.startswith('world')]


def test_a_run_alone_gives_the_actuator_and_writes_only_that(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / 'robot_runs').mkdir()
    run = (folder / 'robot_runs' / 'weave.csv').read_bytes()
    (tmp_path / 'robot_runs' / 'weave.csv').write_bytes(run)
    output = tmp_path / 'fitted.yaml'
    assert main(['--data', str(tmp_path), '--jobs', '1', '-o', str(output)]) == 0
    sim = yaml.safe_load(output.read_text())['/**/sim_node']['ros__parameters']
    assert sorted(sim) == ['actuator.dead_time', 'actuator.lag']
    assert 'actuator.lag' in capsys.readouterr().out


def test_a_wrong_command_is_one_line_and_status_2(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for arguments, named in (
        ([str(tmp_path)], 'holds none of'),
        ([str(folder), '--seed', '-1'], '--seed is -1'),
        ([str(folder), '-o', str(tmp_path / 'no' / 'file.yaml')], 'there is no folder'),
    ):
        assert main(['--data', *arguments]) == 2
        error = capsys.readouterr().err
        assert named in error
        assert error.count('\n') == 1


def test_the_bootstrap_of_a_mean_is_its_standard_error() -> None:
    sample = np.random.default_rng(0).normal(3.0, 2.0, 400)
    residual = (sample.mean() - sample)[:, None]
    deviation = bootstrap_deviation(residual, np.ones((400, 1, 1)), seed=0)
    assert deviation[0] == pytest.approx(sample.std() / 20.0, rel=0.1)


@pytest.mark.parametrize(
    ('value', 'deviation', 'expected'),
    [(0.19607, 0.0029, 0.196), (0.0372591, 0.00054, 0.0373), (0.1234567, 0.0, 0.123457)],
)
def test_a_value_keeps_the_digits_that_are_certain(value, deviation, expected) -> None:
    assert rounded(value, deviation) == pytest.approx(expected)
