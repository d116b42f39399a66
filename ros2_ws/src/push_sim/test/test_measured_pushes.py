"""The plant beside a part of the measurements; all of them are the command `validate`."""

import os
from pathlib import Path

import numpy as np
import pytest
from push_core.data.prediction_accuracy import accuracy
from push_core.physics.slider import Slider
from push_sim.measured.measured_data import MeasuredData, read_measured_data
from push_sim.measured.replay import replay_long_pushes, replay_short_pushes
from push_sim.measured.tip_replay import rms_coordinate, tip_error
from push_sim.settings.profiles import profile

DATA = Path(os.environ.get('PUSH_DATA_DIR', Path(__file__).parents[5] / 'shared' / 'data'))
EVERY = 25

pytestmark = pytest.mark.skipif(
    not DATA.is_dir(), reason=f'no measured pushes in {DATA}; PUSH_DATA_DIR names another place'
)


@pytest.fixture(scope='module')
def data() -> MeasuredData:
    return read_measured_data(DATA)


def test_short_pushes_come_out_as_measured(data: MeasuredData, slider: Slider) -> None:
    assert data.short is not None
    pushes = data.short.take(np.arange(0, len(data.short), EVERY))
    made = replay_short_pushes(profile('irb120').world, slider, pushes.inputs, pushes.distance)
    # a GP of 1000 measured pushes reaches 0.037, a fitted ellipsoid 0.066
    assert accuracy(made, pushes).nmse_push_frame.mean() <= 0.07


def test_long_pushes_that_stay_on_the_face_end_as_measured(
    data: MeasuredData, slider: Slider
) -> None:
    pushes = data.long['square_50mm_pushes_abs_10mms.csv']
    chosen = np.zeros(len(pushes), dtype=np.bool_)
    chosen[np.flatnonzero(pushes.on_face)[::9]] = True
    rows = np.flatnonzero(chosen)
    ends = pushes.end.copy()
    ends[rows] = replay_long_pushes(
        profile('irb120').world,
        slider,
        *(column[rows] for column in (pushes.start, pushes.tip_start, pushes.tip_end)),
    )
    error = pushes.errors(ends).of(chosen)
    assert error['mean_mm'] <= 3.8
    assert error['mean_deg'] <= 4.3


def test_the_tip_of_the_unperturbed_run_follows_as_measured(data: MeasuredData) -> None:
    run = next(run for run in data.runs if 'unperturbed' in run.name)
    assert rms_coordinate(tip_error(run, profile('irb120').actuator)) <= 0.25e-3
