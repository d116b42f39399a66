from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from push_core.common.errors import InputError, RunError
from push_core.data.push_set import P_Y_LIMIT, PushSet
from push_gp.models.analytical_model import AnalyticalModel
from push_gp.models.gp_model import GpModel
from push_gp.models.model_file import load_model, save_model
from push_gp.regression import gp
from push_gp.regression.gp import factor
from push_gp.server.model_server import ModelServer

NO_PUSHES = PushSet(np.zeros(0), np.zeros(0), np.zeros((0, 3)), 0.004)


@pytest.fixture
def server(model: GpModel) -> ModelServer:
    return ModelServer(model, max_points=80)


def test_no_finite_push_into_the_face_gives_anything_but_finite_numbers(
    model: GpModel,
) -> None:
    server = ModelServer(model, max_points=80)
    pushes = st.tuples(
        st.floats(-P_Y_LIMIT, P_Y_LIMIT), st.floats(0, np.pi, exclude_min=True, exclude_max=True)
    )

    @settings(max_examples=100)
    @given(st.lists(pushes, max_size=20))
    def check(batch: list[tuple[float, float]]) -> None:
        p_y, beta = np.array(batch).reshape(-1, 2).T
        found = server.predict(p_y, beta, want_variance=True)
        assert found.mean.shape == found.variance.shape == (len(batch), 3)
        for values in (found.mean, found.jacobian, found.variance):
            assert np.isfinite(values).all()

    check()


@pytest.mark.parametrize(
    ('p_y', 'beta', 'fault'),
    [
        ([0.0, 0.0], [1.0], '2 p_y but 1 beta'),
        ([0.0, np.nan], [1.0, 1.0], 'push 1: p_y = nan, beta = 1 is not finite'),
        ([0.0], [np.inf], 'not finite'),
        ([-0.0501], [1.0], r'must be within 0\.05 m'),
        ([0.0], [0.0], 'between 0 and pi'),
        ([0.0], [np.pi], 'between 0 and pi'),
        ([0.0], [-1.0], 'between 0 and pi'),
    ],
)
def test_what_is_no_push_is_refused_with_its_reason(
    server: ModelServer, p_y: list[float], beta: list[float], fault: str
) -> None:
    with pytest.raises(InputError, match=fault):
        server.predict(np.array(p_y), np.array(beta), want_variance=False)


def test_the_variance_is_given_only_where_it_is_asked_for(server: ModelServer) -> None:
    one = np.array([0.0]), np.array([1.5])
    assert server.predict(*one, want_variance=False).variance.size == 0
    assert server.predict(*one, want_variance=True).variance.size == 3
    with pytest.raises(RunError, match='no variance'):
        ModelServer(AnalyticalModel(), 80).predict(*one, want_variance=True)


def test_the_first_variance_and_the_first_added_pushes_factor_no_covariance_of_all(
    model: GpModel, more_pushes: PushSet, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    save_model(tmp_path / 'model.npz', model)
    server = ModelServer(load_model(tmp_path / 'model.npz'), max_points=80)
    sizes: list[int] = []

    def watched(covariance: np.ndarray) -> np.ndarray:
        sizes.append(len(covariance))
        return factor(covariance)

    monkeypatch.setattr(gp, 'factor', watched)
    server.predict(more_pushes.p_y, more_pushes.beta, want_variance=True)
    assert sizes == []
    server.add_pushes(more_pushes)
    assert max(sizes) == len(more_pushes)


def test_added_pushes_change_answers_and_identity(
    server: ModelServer, more_pushes: PushSet
) -> None:
    before, one = server.info, (more_pushes.p_y[:1], more_pushes.beta[:1])
    doubt = server.predict(*one, want_variance=True).variance
    server.add_pushes(more_pushes)
    assert server.info.points == 72
    assert server.info.model_id != before.model_id
    assert (server.predict(*one, want_variance=True).variance < doubt).all()


def test_pushes_that_cannot_be_added_leave_the_model_as_it_was(
    server: ModelServer, more_pushes: PushSet
) -> None:
    before = server.info.model_hash
    other = PushSet(more_pushes.p_y, more_pushes.beta, more_pushes.displacement, 0.01)
    for pushes, fault in ((NO_PUSHES, 'no pushes'), (other, 'do not join')):
        with pytest.raises(InputError, match=fault):
            server.add_pushes(pushes)
    assert server.info.model_hash == before


def test_beyond_the_cap_the_older_of_the_closest_pushes_go(
    server: ModelServer, more_pushes: PushSet
) -> None:
    for _ in range(3):
        server.add_pushes(more_pushes)
    assert server.info.points == 80
    answers = server.predict(more_pushes.p_y, more_pushes.beta, want_variance=False)
    assert np.isfinite(answers.mean).all()


def test_the_motion_cone_does_not_learn(more_pushes: PushSet) -> None:
    with pytest.raises(InputError, match='cannot be extended'):
        ModelServer(AnalyticalModel(), 80).add_pushes(more_pushes)


def test_pushes_that_contradict_physics_are_not_added(
    server: ModelServer, more_pushes: PushSet
) -> None:
    before = server.model
    wrong = replace(more_pushes, displacement=more_pushes.displacement * [1.0, 1.0, 57.3])
    with pytest.raises(InputError, match='dtheta_rad look like degrees'):
        server.add_pushes(wrong)
    assert server.model is before


def test_a_push_that_comes_twice_is_added_once(server: ModelServer, more_pushes: PushSet) -> None:
    before = server.info.points
    (warning,) = server.add_pushes(more_pushes.joined(more_pushes))
    assert server.info.points == before + len(more_pushes)
    assert warning.endswith('copies of others and are left out')
