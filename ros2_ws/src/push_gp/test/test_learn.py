"""The pushes of a lap, and the motion cone that they tell of."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from push_core.data import P_Y_LIMIT, PushSet
from push_core.geometry import displacement_of, twist_of
from push_core.physics import Slider, with_inertia
from push_gp.learn import ConeLearner, identified, interrupted, segments
from push_gp.learn.cone_learner import loss
from push_gp.learn.identification import LARGEST_CHANGE, huber_roots
from push_gp.models import SmoothCone

DISTANCE = 0.004
NOMINAL = Slider()


def pushes_of(slider: Slider, count: int = 160, noise: float = 0.0, seed: int = 0) -> PushSet:
    """Pushes of a smooth cone, at places as a lap has them, in the order of time."""
    random = np.random.default_rng(seed)
    place = np.linspace(0.0, 4.0 * math.pi, count)
    p_y = 0.008 * np.sin(place) + random.normal(0.0, 1e-3, count)
    beta = 0.5 * math.pi + 0.6 * np.cos(place) + random.normal(0.0, 0.05, count)
    moved, _ = SmoothCone(slider, DISTANCE).evaluate(p_y, beta)
    unit = np.array([1.0, 1.0, 1.0 / 0.045]) * DISTANCE
    return PushSet(p_y, beta, moved + noise * unit * random.normal(size=moved.shape), DISTANCE)


@pytest.mark.parametrize(('friction', 'radius'), [(0.1, 0.028), (0.3, 0.031), (0.2, 0.045)])
def test_a_cone_is_identified_from_its_own_pushes(friction, radius):
    truth = replace(NOMINAL, friction_pusher=friction, support_radius=radius)
    found = identified(pushes_of(truth), NOMINAL)
    assert found.model.slider.friction_pusher == pytest.approx(friction, rel=0.05)
    assert found.model.slider.support_radius == pytest.approx(radius, rel=0.01)


def pushes_at_speed(slider: Slider, speed: float) -> PushSet:
    """The same pushes, of an object whose inertia counts."""
    slow = pushes_of(slider)
    cone = SmoothCone(slider, DISTANCE)
    twists = twist_of(*cone.evaluate(slow.p_y, slow.beta))
    moved, _ = displacement_of(*with_inertia(slider, speed, slow.p_y, *twists))
    return PushSet(slow.p_y, slow.beta, moved, DISTANCE)


@pytest.mark.parametrize('speed', [0.2, 0.3])
def test_the_cone_of_slow_pushes_is_identified_from_fast_ones(speed):
    truth = replace(NOMINAL, friction_pusher=0.2, support_radius=0.034)
    pushes = pushes_at_speed(truth, speed)
    found = identified(pushes, NOMINAL, speed)
    assert found.model.slider.friction_pusher == pytest.approx(0.2, rel=0.05)
    assert found.model.slider.support_radius == pytest.approx(0.034, rel=0.01)
    assert loss(found.model, pushes, speed) < 0.1 * loss(found.model, pushes)
    # without inertia in the fit a larger support radius takes its place
    assert identified(pushes, NOMINAL).model.slider.support_radius > 0.037


def test_a_learner_that_knows_the_speed_learns_the_cone_of_slow_pushes():
    truth = replace(NOMINAL, friction_pusher=0.2, support_radius=0.034)
    learner = ConeLearner(NOMINAL)
    learner.speed = 0.3
    learner.learn(pushes_at_speed(truth, 0.3))
    assert learner.known.support_radius[0] == pytest.approx(0.034, rel=0.01)


def test_outliers_hardly_change_what_is_identified():
    truth = replace(NOMINAL, friction_pusher=0.2, support_radius=0.04)
    pushes = pushes_of(truth, noise=0.02)
    displacement = pushes.displacement.copy()
    displacement[::10] = [0.02, -0.03, 0.5]
    spoiled = PushSet(pushes.p_y, pushes.beta, displacement, DISTANCE)
    found = identified(spoiled, NOMINAL)
    assert found.model.slider.support_radius == pytest.approx(0.04, rel=0.1)
    assert found.model.slider.friction_pusher == pytest.approx(0.2, rel=0.3)


def test_what_pushes_do_not_tell_stays_at_the_prior_and_uncertain():
    count = 80
    p_y, beta = np.zeros(count), np.full(count, 0.5 * math.pi)
    straight = np.tile([DISTANCE, 0.0, 0.0], (count, 1))
    found = identified(PushSet(p_y, beta, straight, DISTANCE), NOMINAL)
    value, uncertainty = found.friction
    assert value == pytest.approx(NOMINAL.friction_pusher)
    assert uncertainty > 0.5 * value


def test_the_uncertainty_covers_the_truth():
    truth = replace(NOMINAL, friction_pusher=0.2, support_radius=0.04)
    far = []
    for seed in range(5):
        found = identified(pushes_of(truth, 80, 0.05, seed), NOMINAL)
        value, uncertainty = found.support_radius
        far.append(abs(value - 0.04) / uncertainty)
    assert np.median(far) < 1.5


def test_the_huber_loss_is_quadratic_near_and_linear_far():
    residuals = np.array([-3.0, -0.5, 0.0, 0.5, 1.0, 5.0])
    assert np.allclose(huber_roots(residuals) ** 2, [5.0, 0.25, 0.0, 0.25, 1.0, 9.0])
    assert np.array_equal(np.sign(huber_roots(residuals)), np.sign(residuals))


def lap_of_a_cone(cone: SmoothCone, steps: int = 400) -> tuple[np.ndarray, np.ndarray]:
    """Poses and tips of a simulated push along a bend, 0.8 mm for each sample."""
    pose, tips, poses = np.zeros(3), [], []
    p_y, step = 0.004, 0.0008
    for index in range(steps):
        beta = 0.5 * math.pi + 0.2 * math.sin(index / 60.0)
        tip = NOMINAL.tip_position(pose, p_y)
        poses.append(pose.copy())
        tips.append(tip)
        moved, _ = cone.evaluate(np.array([p_y]), np.array([beta]))
        dx, dy, turn = moved[0] * step / cone.distance
        cos, sin = math.cos(pose[2]), math.sin(pose[2])
        pose = pose + np.array([cos * dx - sin * dy, sin * dx + cos * dy, turn])
        p_y += step * math.cos(beta) - dy - NOMINAL.tip_x * turn
    return np.array(poses), np.array(tips)


def test_segments_of_a_lap_are_pushes_of_its_plant():
    cone = SmoothCone(replace(NOMINAL, support_radius=0.04), DISTANCE)
    found = segments(*lap_of_a_cone(cone), NOMINAL, DISTANCE)
    assert len(found) > 70
    expected, _ = cone.evaluate(found.p_y, found.beta)
    far = np.abs(found.displacement - expected) / [DISTANCE, DISTANCE, DISTANCE / 0.045]
    assert far.max() < 0.03


def noisy_lap(position: float, degrees: float, every: int) -> tuple[np.ndarray, np.ndarray]:
    """A lap of 1.6 m on a plant, as a camera with noise sees one sample of so many."""
    truth = replace(NOMINAL, friction_pusher=0.2, support_radius=0.04)
    poses, tips = lap_of_a_cone(SmoothCone(truth, DISTANCE), 2000)
    noise = np.random.default_rng(0).normal(size=poses.shape)
    sigma = [position, position, math.radians(degrees)]
    return (poses + noise * sigma)[::every], tips[::every]


@pytest.mark.parametrize(('position', 'degrees', 'every'), [(5e-4, 0.5, 1), (1e-3, 1.0, 3)])
def test_a_lap_seen_by_a_noisy_camera_identifies_its_plant(position, degrees, every):
    lap = noisy_lap(position, degrees, every)
    assert not interrupted(*lap, NOMINAL).any()
    found = ConeLearner(NOMINAL, DISTANCE).learn(segments(*lap, NOMINAL, DISTANCE))
    assert found.pushes > 300
    assert found.support_radius[0] == pytest.approx(0.04, rel=0.03)


def test_an_object_that_is_moved_by_hand_ends_a_segment():
    poses, tips = lap_of_a_cone(SmoothCone(NOMINAL, DISTANCE))
    whole = segments(poses, tips, NOMINAL, DISTANCE)
    poses[200:] += [0.03, 0.0, 0.0]
    tips[200:] += [0.03, 0.0]
    cut = segments(poses, tips, NOMINAL, DISTANCE)
    assert len(cut) >= len(whole) - 2
    assert np.abs(cut.displacement[:, :2]).max() < 1.2 * DISTANCE


@pytest.mark.parametrize('value', [math.nan, math.inf, -math.inf, 1e16, 1e308])
@pytest.mark.parametrize('column', range(5))
def test_what_cannot_have_been_measured_ends_a_segment(value, column):
    rows = np.column_stack(lap_of_a_cone(SmoothCone(NOMINAL, DISTANCE)))
    whole = segments(rows[:, :3], rows[:, 3:], NOMINAL, DISTANCE)
    rows[200, column] = value
    cut = segments(rows[:, :3], rows[:, 3:], NOMINAL, DISTANCE)
    assert len(cut) >= len(whole) - 2
    assert np.abs(cut.displacement[:, :2]).max() < 1.2 * DISTANCE


@pytest.mark.parametrize('value', [math.nan, math.inf, 1e308])
def test_a_lap_of_nothing_that_can_have_been_measured_has_no_segment(value):
    assert len(segments(np.full((9, 3), value), np.full((9, 2), value), NOMINAL, DISTANCE)) == 0


def test_a_tip_that_does_not_touch_makes_no_segment():
    poses, tips = lap_of_a_cone(SmoothCone(NOMINAL, DISTANCE))
    assert len(segments(poses, tips - [0.01, 0.0], NOMINAL, DISTANCE)) == 0
    assert len(segments(poses[:1], tips[:1], NOMINAL, DISTANCE)) == 0


def test_a_cone_that_predicts_worse_is_not_taken():
    learner = ConeLearner(NOMINAL, DISTANCE)
    truth = replace(NOMINAL, friction_pusher=0.2, support_radius=0.04)
    good = learner.learn(pushes_of(truth))
    assert good.model.slider.support_radius == pytest.approx(0.04, rel=0.02)
    assert learner.learn(pushes_of(truth, count=20)) is good


FINITE = st.floats(-0.05, 0.05)
ROWS = st.integers(2, 120)


@settings(max_examples=10, deadline=None)
@given(data=st.data(), count=ROWS)
def test_whatever_comes_in_the_next_cone_is_finite_and_no_worse_on_unseen_pushes(data, count):
    p_y = data.draw(arrays(float, count, elements=st.floats(-P_Y_LIMIT, P_Y_LIMIT)))
    beta = data.draw(arrays(float, count, elements=st.floats(0.02, math.pi - 0.02)))
    moved = data.draw(arrays(float, (count, 3), elements=FINITE))
    learner = ConeLearner(NOMINAL, DISTANCE)
    nominal = learner.known
    garbage = PushSet(p_y, beta, moved, DISTANCE)
    found = learner.learn(garbage)
    slider = found.model.slider
    change = np.log(
        [
            slider.friction_pusher / NOMINAL.friction_pusher,
            slider.support_radius / NOMINAL.support_radius,
        ]
    )
    assert np.isfinite(found.covariance).all()
    assert (np.abs(change) <= LARGEST_CHANGE + 1e-9).all()
    mean, jacobian = found.model.evaluate(np.linspace(-0.04, 0.04, 9), np.linspace(0.1, 3.0, 9))
    assert np.isfinite(mean).all()
    assert np.isfinite(jacobian).all()
    # what it is driven with afterwards explains the lap at least as well as the nominal cone
    assert loss(found.model, garbage) <= loss(nominal.model, garbage) * (1.0 + 1e-6) + 1e-6
