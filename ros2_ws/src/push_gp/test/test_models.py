from dataclasses import replace

import numpy as np
import pytest
from push_core.common.errors import InputError, RunError
from push_core.data.push_set import PushSet
from push_core.physics.slider import Slider
from push_gp.low_rank.chebyshev import HALF_WIDTH
from push_gp.models.analytical_model import AnalyticalModel
from push_gp.models.gp_model import GpModel
from push_gp.models.mean_function import ConeMean, ZeroMean
from push_gp.models.model import PushModel
from push_gp.models.smooth_cone import SmoothCone
from push_gp.training.fit_cone import fitted_cone
from push_gp.training.train import train

Queries = tuple[np.ndarray, np.ndarray]


@pytest.fixture(params=['gp', 'gp over the cone', 'cone', 'smooth cone'])
def any_model(request: pytest.FixtureRequest, model: GpModel, pushes: PushSet) -> PushModel:
    if request.param == 'gp':
        return model
    cones = {'cone': AnalyticalModel(), 'smooth cone': SmoothCone()}
    return cones.get(request.param) or train(pushes, 'analytical')


def test_the_jacobian_is_that_of_central_differences(
    any_model: PushModel, queries: Queries
) -> None:
    p_y, beta = queries
    _, jacobian = any_model.evaluate(p_y, beta)
    for column, (along_p_y, along_beta) in enumerate([(1e-7, 0.0), (0.0, 1e-5)]):
        ahead, _ = any_model.evaluate(p_y + along_p_y, beta + along_beta)
        behind, _ = any_model.evaluate(p_y - along_p_y, beta - along_beta)
        differences = (ahead - behind) / (2.0 * (along_p_y + along_beta))
        scale = np.abs(differences).max(axis=0)
        assert (np.abs(jacobian[:, :, column] - differences) <= 1e-6 * scale).all()


def test_one_push_more_or_less_in_the_batch_changes_no_answer(
    any_model: PushModel, queries: Queries
) -> None:
    p_y, beta = queries
    mean, jacobian = any_model.evaluate(p_y, beta)
    first_mean, first_jacobian = any_model.evaluate(p_y[:1], beta[:1])
    assert mean.shape == (40, 3)
    assert jacobian.shape == (40, 3, 2)
    assert np.allclose(first_mean, mean[:1], rtol=1e-12, atol=0.0)
    assert np.allclose(first_jacobian, jacobian[:1], rtol=1e-9, atol=1e-15)


def test_the_gp_learns_what_made_the_pushes(model: GpModel, queries: Queries) -> None:
    mean, _ = model.evaluate(*queries)
    truth, _ = AnalyticalModel().evaluate(*queries)
    assert (np.sqrt(np.mean((mean - truth) ** 2, axis=0)) < [3e-4, 3e-4, 8e-3]).all()


def test_the_variance_shrinks_towards_the_pushes(model: GpModel, pushes: PushSet) -> None:
    there = model.variance(pushes.p_y, pushes.beta)
    beside = model.variance(np.array([0.05]), np.array([0.01]))
    assert there.shape == (60, 3)
    assert (there < beside).all()
    assert (there < model.noise_variance).all()


def test_the_motion_cone_states_no_variance(queries: Queries) -> None:
    with pytest.raises(RunError, match='no variance'):
        AnalyticalModel().variance(*queries)


def test_an_extended_model_is_the_model_of_all_pushes(
    model: GpModel, pushes: PushSet, more_pushes: PushSet, queries: Queries
) -> None:
    extended = model.extended(more_pushes)
    hyperparameters = [process.hyperparameters for process in model.processes]
    rebuilt = GpModel.conditioned(pushes.joined(more_pushes), ZeroMean(), hyperparameters)
    for ours, theirs in zip(extended.evaluate(*queries), rebuilt.evaluate(*queries), strict=True):
        assert np.allclose(ours, theirs, rtol=1e-8, atol=1e-12)
    assert extended.info.points == 72
    assert extended.info.training_set_hash == rebuilt.info.training_set_hash
    assert model.info.points == 60


def test_pushes_of_another_distance_do_not_extend_a_model(
    model: GpModel, more_pushes: PushSet
) -> None:
    with pytest.raises(InputError, match='do not join'):
        model.extended(replace(more_pushes, distance=0.005))


def test_whatever_changes_an_answer_changes_the_hash(
    model: GpModel, pushes: PushSet, more_pushes: PushSet
) -> None:
    displacement = pushes.displacement.copy()
    displacement[3, 1] += 1e-9
    moved = replace(pushes, displacement=displacement)
    hyperparameters = [process.hyperparameters for process in model.processes]
    louder = [hyperparameters[0], hyperparameters[1], replace(hyperparameters[2], noise_std=0.01)]
    hashes = {
        each.info.model_hash
        for each in (
            model,
            model.extended(more_pushes),
            GpModel.conditioned(moved, ZeroMean(), hyperparameters),
            GpModel.conditioned(pushes, ZeroMean(), louder),
            GpModel.conditioned(pushes, ConeMean(AnalyticalModel()), hyperparameters),
            AnalyticalModel(),
            AnalyticalModel(Slider(friction_pusher=0.2)),
            AnalyticalModel(distance=0.005),
            SmoothCone(),
            SmoothCone(Slider(friction_pusher=0.2)),
        )
    }
    assert len(hashes) == 10


def test_the_info_states_the_domain_of_the_pushes(model: GpModel, pushes: PushSet) -> None:
    assert model.info.p_y_domain == (pushes.p_y.min(), pushes.p_y.max())
    assert model.info.beta_domain == (pushes.beta.min(), pushes.beta.max())
    assert model.info.model_id == model.info.model_hash[:12]


def test_the_fitted_cone_finds_the_slider_that_made_the_pushes(pushes: PushSet) -> None:
    slider = fitted_cone(pushes).slider
    assert slider.friction_pusher == pytest.approx(0.3, abs=0.03)
    assert slider.support_radius == pytest.approx(0.0348, abs=5e-4)


def test_the_mean_over_a_cone_is_the_cone_without_its_edge() -> None:
    cone = AnalyticalModel()
    p_y, beta = np.full(600, 0.01), np.linspace(0.3, np.pi - 0.3, 600)
    slope = ConeMean(cone).evaluate(p_y, beta)[1][:, :, 1]
    sharp = cone.evaluate(p_y, beta)[1][:, :, 1]
    jump, sharp_jump = (np.abs(np.diff(each, axis=0)).max() for each in (slope, sharp))
    assert jump < 0.2 * sharp_jump
    away = np.array([0.0]), np.array([0.5 * np.pi])
    assert np.allclose(ConeMean(cone).evaluate(*away)[0], cone.evaluate(*away)[0], atol=1e-4)


def test_the_mean_over_a_cone_is_that_of_normally_distributed_directions() -> None:
    cone = AnalyticalModel()
    generator = np.random.default_rng(6)
    spread = np.linspace(-5.0, 5.0, 4001)
    shares = np.exp(-0.5 * spread**2)
    for p_y, beta in generator.uniform([-0.045, 0.1], [0.045, 3.0], (20, 2)):
        means, _ = cone.evaluate(np.full(spread.size, p_y), beta + 0.2 * spread)
        (mean,), _ = ConeMean(cone).evaluate(np.array([p_y]), np.array([beta]))
        expected = shares @ means / shares.sum()
        assert np.allclose(mean, expected, rtol=0.0, atol=5e-4 * cone.distance / 0.045)


def test_the_mean_over_a_cone_does_not_jump_where_its_polynomials_end() -> None:
    mean = ConeMean(AnalyticalModel())
    edge = 0.5 * np.pi + HALF_WIDTH[1]
    inside, outside = (
        mean.evaluate(np.array([0.01]), np.array([edge + step]))[0] for step in (-1e-9, 1e-9)
    )
    assert np.allclose(inside, outside, atol=5e-4 * mean.cone.distance / 0.045)
