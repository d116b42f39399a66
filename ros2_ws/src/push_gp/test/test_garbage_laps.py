"""Whatever is measured, the next model is no worse than the cone by more than it says.

The pushes of a lap come from a plant; some of them are replaced by anything that fits the format.
"""

import math
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from push_core.data import HALF_FACE, P_Y_LIMIT, PushSet
from push_core.physics import Slider
from push_gp.learn import ConeLearner, Identified, segments
from push_gp.learn.identification import LARGEST_CHANGE
from push_gp.models import SmoothCone

DISTANCE, NOMINAL = 0.004, Slider()
STEP = 1e-3  # of the logarithms of friction and support radius
MOTION = st.floats(-2e-3, 2e-3)  # [m], [rad] from one picture to the next
UNIT = np.array([1.0, 1.0, HALF_FACE])

PLANTS = st.builds(
    lambda friction, radius: replace(NOMINAL, friction_pusher=friction, support_radius=radius),
    st.floats(0.05, 0.6),
    st.floats(0.02, 0.06),
)


def places(count: int, random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Contact offsets and push directions (n,) as a lap of the eight has them."""
    along = np.linspace(0.0, 4.0 * math.pi, count)
    p_y = 0.008 * np.sin(along) + random.normal(0.0, 2e-3, count)
    beta = 0.5 * math.pi + 0.5 * np.cos(along) + random.normal(0.0, 0.1, count)
    return np.clip(p_y, -0.04, 0.04), np.clip(beta, 0.1, math.pi - 0.1)


def moved(slider: Slider, p_y: np.ndarray, beta: np.ndarray) -> np.ndarray:
    """Displacements (n, 3), the turn as that of the end of the face [m]."""
    return SmoothCone(slider, DISTANCE).evaluate(p_y, beta)[0] * UNIT


def stated(found: Identified, p_y: np.ndarray, beta: np.ndarray) -> float:
    """Root mean square of the standard deviation of the predicted motion [m]."""
    slider = found.model.slider
    factors = np.exp(STEP * np.eye(2))
    moves = [
        replace(
            slider,
            friction_pusher=slider.friction_pusher * friction,
            support_radius=slider.support_radius * radius,
        )
        for friction, radius in factors
    ]
    centre = moved(slider, p_y, beta)
    slopes = np.stack([(moved(each, p_y, beta) - centre) / STEP for each in moves], axis=-1)
    variance = np.einsum('nij,jk,nik->ni', slopes, found.covariance, slopes)
    return math.sqrt(float(variance.sum(axis=1).mean()))


def distance(found: np.ndarray, truth: np.ndarray) -> float:
    """Root mean square [m] of what two sets of displacements differ by."""
    return math.sqrt(float(((found - truth) ** 2).sum(axis=1).mean()))


@settings(deadline=None, max_examples=15, derandomize=True)
@given(plant=PLANTS, share=st.floats(0.0, 0.3), seed=st.integers(0, 10**6), data=st.data())
def test_on_unseen_pushes_the_next_cone_is_no_worse_than_the_nominal_one(
    plant, share, seed, data
) -> None:
    random = np.random.default_rng(seed)
    p_y, beta = places(160, random)
    measured = moved(plant, p_y, beta) / UNIT + 1e-4 * random.normal(size=(160, 3))
    spoiled = random.random(160) < share
    scale = data.draw(st.sampled_from([1e-3, 0.05, 0.9]))
    measured[spoiled] = random.uniform(-scale, scale, (int(spoiled.sum()), 3))
    found = ConeLearner(NOMINAL, DISTANCE).learn(PushSet(p_y, beta, measured, DISTANCE))
    unseen = places(80, np.random.default_rng(seed + 1))
    truth = moved(plant, *unseen)
    nominal = distance(moved(NOMINAL, *unseen), truth)
    learned = distance(moved(found.model.slider, *unseen), truth)
    assert learned <= nominal + 2.0 * stated(found, *unseen)


@settings(deadline=None, max_examples=60, derandomize=True)
@given(data=st.data(), count=st.integers(0, 400))
def test_wherever_object_and_tip_go_the_next_cone_is_finite_and_physical(data, count) -> None:
    poses = np.cumsum(data.draw(arrays(float, (count, 3), elements=MOTION)), axis=0)
    tips = np.cumsum(data.draw(arrays(float, (count, 2), elements=MOTION)), axis=0)
    found = segments(poses, tips, NOMINAL, DISTANCE)
    assert np.isfinite(found.displacement).all()
    assert (np.abs(found.p_y) <= P_Y_LIMIT).all()
    slider = ConeLearner(NOMINAL, DISTANCE).learn(found).model.slider
    change = np.log(
        [
            slider.friction_pusher / NOMINAL.friction_pusher,
            slider.support_radius / NOMINAL.support_radius,
        ]
    )
    assert (np.abs(change) <= LARGEST_CHANGE + 1e-9).all()
