"""Errors on the measured pushes; the bounds are the figures of the data set's README."""

import os
from pathlib import Path

import numpy as np
import pytest
from push_core.data.long_push_csv import read_long_pushes
from push_core.data.prediction_accuracy import accuracy
from push_core.data.push_set import PushSet
from push_core.physics.slider import Slider
from push_gp.evaluation.evaluation import rollout_evaluation
from push_gp.evaluation.uncertainty import score_uncertainty
from push_gp.models.analytical_model import AnalyticalModel
from push_gp.models.model import PushModel
from push_gp.models.sampling import nested_rows, subset_rows
from push_gp.training.train import train


def split(measured: PushSet, rows: np.ndarray) -> tuple[PushSet, PushSet]:
    rest = np.setdiff1d(np.arange(len(measured)), rows)
    return measured.take(rows), measured.take(rest)


def push_frame_nmse(model: PushModel, pushes: PushSet) -> float:
    predicted, _ = model.evaluate(pushes.p_y, pushes.beta)
    return float(accuracy(predicted, pushes).nmse_push_frame.mean())


@pytest.mark.parametrize(('points', 'worst'), [(100, 0.052), (200, 0.050), (500, 0.042)])
def test_the_gp_tells_held_out_pushes_as_well_as_published_and_knows_how_well(
    measured: PushSet, points: int, worst: float
) -> None:
    training, rest = split(measured, subset_rows(measured, f'subset_{points}'))
    model = train(training)
    assert push_frame_nmse(model, rest) <= worst
    score = score_uncertainty(model, rest)
    assert score is not None
    assert (score.coverage_95 >= 0.92).all()
    assert (score.coverage_95 <= 0.97).all()


def test_the_fitted_limit_surface_has_the_published_error_in_both_frames(
    measured: PushSet,
) -> None:
    cone = AnalyticalModel(Slider(friction_pusher=0.229, support_radius=0.0348))
    predicted, _ = cone.evaluate(measured.p_y, measured.beta)
    found = accuracy(predicted, measured)
    assert found.nmse_push_frame.mean() == pytest.approx(0.066, abs=0.002)
    assert found.nmse_body_frame.mean() == pytest.approx(0.136, abs=0.008)


@pytest.mark.parametrize(('points', 'median'), [(5, 0.085), (10, 0.080), (20, 0.070)])
def test_over_the_cone_a_handful_of_pushes_is_enough(
    measured: PushSet, points: int, median: float
) -> None:
    found = []
    for seed in range(5):
        training, rest = split(measured, nested_rows(measured, points, seed))
        found.append(push_frame_nmse(train(training, 'analytical'), rest))
    assert np.median(found) <= median


def test_rolled_out_along_50_mm_it_ends_as_near_as_published(measured: PushSet) -> None:
    beside_the_project = Path(__file__).resolve().parents[5] / 'shared' / 'data'
    folder = Path(os.environ.get('PUSH_DATA_DIR', beside_the_project))
    pushes = read_long_pushes(folder / 'square_50mm_pushes_abs_10mms.csv')
    model = train(measured.take(subset_rows(measured, 'subset_200')))
    found = rollout_evaluation(model, pushes).as_json()['rollout']['on_face']
    assert found['n'] == 297
    assert 3.0 < found['mean_mm'] < 4.0
    assert 3.5 < found['mean_deg'] < 4.5
