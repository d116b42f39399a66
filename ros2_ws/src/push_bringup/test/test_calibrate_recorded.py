"""Dead time and lag of a robot, found from the bag of a lap."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from push_bag.run.commanded_tip import commanded_tip
from push_bringup.commands.cell import main as cell
from push_core.common import InputError
from push_core.physics import ActuatorSettings
from push_sim.calibration import calibrate_recorded
from push_sim.commands.calibrate import main as calibrate

SQUARE = ('--mode', 'inprocess', '--track', 'square', '--speed', '0.05')
GUESS = ActuatorSettings()


@pytest.fixture(scope='module')
def lap(tmp_path_factory: pytest.TempPathFactory):
    """Pushes a lap; returns its folder."""

    def push(*changes: str) -> Path:
        runs = tmp_path_factory.mktemp('laps') / 'runs'
        words = [word for change in changes for word in ('-p', change)]
        assert cell([*SQUARE, '--controller', 'analytical', *words, '-o', str(runs)]) == 0
        (folder,) = runs.iterdir()
        return folder

    return push


@pytest.fixture(scope='module')
def usual(lap) -> Path:
    return lap()


def fitted(recorded, guess=GUESS) -> tuple[float, float]:
    dead_time, lag = calibrate_recorded(recorded, guess, seed=0).parameters
    return dead_time.value, lag.value


@pytest.mark.parametrize(
    ('dead_time', 'lag', 'known'),
    [(0.06, 0.049, True), (0.03, 0.08, True), (0.09, 0.02, False)],
    ids=['irb120', 'other', 'other than the controller assumed'],
)
def test_a_lap_tells_dead_time_and_lag_within_a_millisecond(lap, dead_time, lag, known) -> None:
    whose = '' if known else 'sim_node.'
    folder = lap(f'{whose}actuator.dead_time:={dead_time}', f'{whose}actuator.lag:={lag}')
    recorded = commanded_tip(folder)
    far = replace(GUESS, dead_time=0.02, lag=0.15)
    assert fitted(recorded, far) == pytest.approx((dead_time, lag), abs=1e-3)


def test_a_tip_measured_with_noise_at_a_rate_of_its_own_tells_them_within_10_ms(usual) -> None:
    recorded, random = commanded_tip(usual), np.random.default_rng(0)
    time = np.sort(random.uniform(0.0, recorded.time[-1], 4 * len(recorded.time)))
    tip = np.column_stack([np.interp(time, recorded.time, axis) for axis in recorded.tip.T])
    noisy = replace(recorded, time=time, tip=tip + random.normal(0.0, 2e-4, tip.shape))
    result = calibrate_recorded(noisy, GUESS, seed=0)
    dead_time, lag = (each.value for each in result.parameters)
    assert dead_time + lag == pytest.approx(0.109, abs=2e-3)
    assert (dead_time, lag) == pytest.approx((0.06, 0.049), abs=0.01)
    assert result.after == pytest.approx(2e-4, rel=0.1)
    spread = np.array([each.deviation for each in result.parameters])
    assert np.all(spread > 1e-4)


def test_a_tip_that_was_moved_aside_by_hand_is_told_from_the_rest(lap) -> None:
    pushed = lap('perturbation.kind:=tangential')
    assert fitted(commanded_tip(pushed)) == pytest.approx((0.06, 0.049), abs=1e-3)


def test_the_command_writes_a_parameter_file_for_plant_and_controller(
    usual, tmp_path, capsys
) -> None:
    capsys.readouterr()
    output = tmp_path / 'fitted.yaml'
    assert calibrate(['--data', str(usual), '-o', str(output)]) == 0
    told = capsys.readouterr().out
    assert 'actuator.dead_time  0.06000' in told
    assert 'mm rms of a coordinate' in told
    text = output.read_text(encoding='utf-8')
    assert text.count('actuator.lag: 0.0490') == 2
    assert calibrate(['--data', str(usual), '--json']) == 0
    figures = json.loads(capsys.readouterr().out)
    assert figures['parameters']['actuator.lag']['value'] == pytest.approx(0.049, abs=1e-4)
    words = [*SQUARE, '--controller', 'analytical', '--params', str(output)]
    assert cell([*words, '-o', str(tmp_path / 'runs')]) == 0


def test_a_tip_that_hardly_moves_is_refused(usual) -> None:
    recorded = commanded_tip(usual)
    still = replace(recorded, time=recorded.time[:20], tip=recorded.tip[:20])
    with pytest.raises(InputError, match='the tip moves 0 mm, too little to tell its lag'):
        calibrate_recorded(still, GUESS, seed=0)
