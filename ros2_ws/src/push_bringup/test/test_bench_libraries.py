import importlib.util
import json
from pathlib import Path

import numpy as np
import pytest
from push_bringup.bench import libraries
from push_bringup.comparison.gp_libraries import fit_gpytorch, fit_ours, fit_scikit_learn
from push_core.data.push_csv import write_pushes
from push_core.data.push_set import PushSet
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider


@pytest.fixture(scope='module')
def pushes() -> PushSet:
    generator = np.random.default_rng(1)
    p_y, beta = generator.uniform(-0.044, 0.044, 60), generator.uniform(0.2, 2.9, 60)
    rate, _ = MotionCone(Slider()).evaluate(p_y, beta)
    return PushSet(p_y, beta, 0.004 * rate + generator.normal(size=(60, 3)) * 1e-4, 0.004)


@pytest.mark.parametrize('fit', [fit_scikit_learn, fit_gpytorch])
def test_other_libraries_find_the_same_optimum_and_predictions(pushes: PushSet, fit) -> None:
    if fit is fit_gpytorch and importlib.util.find_spec('gpytorch') is None:
        pytest.skip('no gpytorch; make setup EXTRA=bench installs it')
    ours, theirs = fit_ours(pushes), fit(pushes)
    # our prior still counts with so few pushes
    assert theirs.log_likelihood(pushes) == pytest.approx(ours.log_likelihood(pushes), rel=5e-3)
    queries = pushes.inputs[:7]
    for mine, other in zip(ours.predict(queries), theirs.predict(queries), strict=True):
        scale = np.abs(mine).max(axis=0)
        assert np.all(np.abs(other - mine) < 0.15 * scale)


@pytest.mark.processes
def test_the_comparison_names_what_it_measured(
    pushes: PushSet, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch
) -> None:
    write_pushes(tmp_path / 'pushes.csv', pushes)
    monkeypatch.delitem(libraries.LIBRARIES, 'scikit-learn')
    monkeypatch.setitem(libraries.LIBRARIES, 'GPyTorch', ('no_such_library', fit_gpytorch))
    assert libraries.main([str(tmp_path / 'pushes.csv'), '--points', '40', '--json']) == 0
    shown = capsys.readouterr()
    printed = json.loads(shown.out)
    assert printed['points'] == 40
    (library,) = printed['rivals']
    assert library['name'] == 'push_gp'
    assert 0.0 < library['nmse_push_frame'] < 0.2
    assert library['fit_s'] > 0.0
    assert "GPyTorch is not installed: 'make setup EXTRA=bench' does it" in shown.err


def test_more_points_than_pushes_is_one_line_and_status_2(
    pushes: PushSet, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_pushes(tmp_path / 'pushes.csv', pushes)
    assert libraries.main([str(tmp_path / 'pushes.csv'), '--points', '60']) == 2
    assert 'cannot train on 60 of 60 pushes' in capsys.readouterr().err
