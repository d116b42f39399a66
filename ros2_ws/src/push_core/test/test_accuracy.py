import json

import numpy as np
import pytest
from push_core.data.prediction_accuracy import accuracy, in_push_frame
from push_core.data.push_set import PushSet


def test_the_push_frame_has_x_along_the_push() -> None:
    beta = np.array([np.pi / 2, np.pi / 4, 0.2])
    along = np.column_stack((np.sin(beta), np.cos(beta), np.zeros(3)))
    assert np.allclose(in_push_frame(along, beta), [[1, 0, 0]] * 3)
    # across is to the left of the push, as y is to the left of x
    left = np.array([[0.0, 1.0, 0.5]])
    assert np.allclose(in_push_frame(left, beta[:1]), left)


def test_the_errors_are_those_worked_out_by_hand() -> None:
    moved = np.array([[1e-3, 2e-3, 0.1], [3e-3, 2e-3, 0.3]])
    pushes = PushSet(np.zeros(2), np.full(2, np.pi / 2), moved, 0.004)
    found = accuracy(moved + np.array([1e-3, -2e-3, np.radians(3.0)]), pushes).as_json()
    assert found['n'] == 2
    assert found['rmse'] == pytest.approx({'dx_mm': 1.0, 'dy_mm': 2.0, 'dtheta_deg': 3.0})
    # dx varies by 1 mm about its mean and is off by 1 mm; dy does not vary at all
    assert found['nmse_body_frame']['dx'] == pytest.approx(1.0)
    assert found['nmse_body_frame']['dtheta'] == pytest.approx((np.radians(3.0) / 0.1) ** 2)
    assert found['nmse_body_frame']['dy'] is None
    assert found['nmse_body_frame']['mean'] is None
    assert json.loads(json.dumps(found, allow_nan=False)) == found


def test_predicting_the_average_has_an_nmse_of_one_in_both_frames() -> None:
    generator = np.random.default_rng(1)
    moved = generator.normal(size=(500, 3)) * [1e-3, 1e-3, 0.02]
    pushes = PushSet(np.zeros(500), np.full(500, 1.0), moved, 0.004)
    found = accuracy(np.tile(moved.mean(axis=0), (500, 1)), pushes)
    assert np.allclose(found.nmse_body_frame, 1.0)
    assert np.allclose(found.nmse_push_frame, 1.0)
