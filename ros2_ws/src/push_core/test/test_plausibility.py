"""Pushes that contradict physics are found out, whatever the friction, and real ones are not."""

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from push_core.common import InputError
from push_core.data.plausibility import check_plausible, implausibilities
from push_core.data.push_csv import read_pushes
from push_core.data.push_set import PushSet
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider

DISTANCE = 0.004
DATA = Path(os.environ.get('PUSH_DATA_DIR', Path(__file__).parents[4].parent / 'shared' / 'data'))


def pushes(
    count: int = 100,
    friction: float = 0.2,
    radius: float = 0.035,
    noise: float = 0.0,
    seed: int = 0,
) -> PushSet:
    """Pushes of a slider with this friction and support radius [m], and noise [m, m, 10 rad]."""
    draw = np.random.default_rng(seed)
    p_y, beta = draw.uniform(-0.042, 0.042, count), draw.uniform(0.2, np.pi - 0.2, count)
    slider = replace(Slider(), friction_pusher=friction, support_radius=radius)
    motion = DISTANCE * MotionCone(slider).evaluate(p_y, beta)[0]
    error = noise * draw.normal(size=motion.shape) * [1.0, 1.0, 10.0]
    return PushSet(p_y, beta, motion + error, DISTANCE)


def scaled(given: PushSet, *factors: float) -> PushSet:
    return replace(given, displacement=given.displacement * np.array(factors))


def turned(given: PushSet, angle: object) -> PushSet:
    dx, dy, dtheta = given.displacement.T
    cos, sin = np.cos(angle), np.sin(angle)  # type: ignore[call-overload]
    motion = np.column_stack((cos * dx - sin * dy, sin * dx + cos * dy, dtheta))
    return replace(given, displacement=motion)


MISTAKES: dict[str, tuple[Callable[[PushSet], PushSet], str]] = {
    'degrees': (
        lambda p: scaled(p, 1, 1, 57.2958),
        'dtheta_rad look like degrees: divide by 57.3',
    ),
    'radians twice': (lambda p: scaled(p, 1, 1, 1 / 57.2958), 'dtheta_rad .*multiply by 57.3'),
    'centimetres': (lambda p: scaled(p, 100, 100, 1), 'dx_m and dy_m look like centimetres'),
    'inches': (lambda p: scaled(p, 39.37, 39.37, 1), 'dx_m and dy_m look like inches'),
    'distance times ten': (lambda p: replace(p, distance=0.04), 'distance_m .*divide by 10'),
    'distance over ten': (lambda p: replace(p, distance=0.0004), 'distance_m .*multiply by 10'),
    'sign of dtheta': (lambda p: scaled(p, 1, 1, -1), 'dtheta_rad has the other sign'),
    'sign of dy': (lambda p: scaled(p, 1, -1, 1), 'dy_m has the other sign'),
    'sign of dx': (lambda p: scaled(p, -1, 1, 1), 'dx_m has the other sign'),
    'sign of p_y': (lambda p: replace(p, p_y=-p.p_y), 'p_y_m has the other sign'),
    'mirrored beta': (lambda p: replace(p, beta=np.pi - p.beta), 'beta_rad is mirrored'),
    'exchanged': (
        lambda p: replace(p, displacement=p.displacement[:, [1, 0, 2]]),
        'dx_m and dy_m are exchanged',
    ),
    'turned frame': (lambda p: turned(p, 0.7), r'turned by (3\d|4\d) degrees'),
    'world frame': (
        lambda p: turned(p, np.random.default_rng(1).uniform(-np.pi, np.pi, len(p))),
        'not in the body frame',
    ),
    'nothing moved': (lambda p: scaled(p, 0, 0, 0), 'did not move'),
}


@pytest.mark.parametrize('mistake', MISTAKES)
@pytest.mark.parametrize('friction', [0.15, 0.3])
def test_a_mistake_is_refused_by_name(mistake: str, friction: float) -> None:
    spoil, message = MISTAKES[mistake]
    with pytest.raises(InputError, match=message):
        check_plausible(spoil(pushes(friction=friction, noise=5e-5)), 'pushes.csv')


def test_what_is_impossible_is_a_warning_by_force() -> None:
    (warning,) = check_plausible(scaled(pushes(), 1, 1, -1), 'pushes.csv', force=True)
    assert warning.startswith('pushes.csv: dtheta_rad has the other sign')


@pytest.mark.parametrize('friction', [0.0, 0.05, 0.15, 0.3, 0.6, 0.9])
@pytest.mark.parametrize('radius', [0.022, 0.028, 0.035, 0.045, 0.06])
def test_no_friction_and_no_support_is_called_a_mistake(friction: float, radius: float) -> None:
    given = pushes(friction=friction, radius=radius, noise=2e-4)
    assert list(implausibilities(given)) == []


@pytest.mark.parametrize('count', [1, 2, 3, 5, 10, 20])
def test_few_pushes_are_not_refused(count: int) -> None:
    for seed in range(20):
        assert check_plausible(pushes(count, noise=2e-4, seed=seed), 'few') == []


def test_noise_of_a_webcam_is_no_mistake() -> None:
    noisy = pushes(200, noise=1e-3)
    assert not any(finding.impossible for finding in implausibilities(noisy))


def test_rows_that_do_not_belong_together_are_odd() -> None:
    given = pushes()
    order = np.random.default_rng(2).permutation(len(given))
    (finding,) = implausibilities(replace(given, displacement=given.displacement[order]))
    assert not finding.impossible
    assert 'not explained by quasi-static pushing' in finding.text


def test_single_faults_are_named_by_row() -> None:
    given = pushes()
    motion = given.displacement.copy()
    motion[[6, 40], 0] = 0.02
    (finding,) = implausibilities(replace(given, displacement=motion))
    assert finding.text.startswith('2 of 100 pushes')
    assert 'push 7, 41' in finding.text


@pytest.mark.skipif(not DATA.is_dir(), reason=f'no measured pushes in {DATA}')
@pytest.mark.parametrize('count', [5, 10, 50, 500])
def test_measured_pushes_pass(count: int) -> None:
    measured = read_pushes(DATA / 'square_4mm_pushes.csv')
    draw = np.random.default_rng(count)
    for _ in range(10):
        few = measured.take(draw.choice(len(measured), count, replace=False))
        assert not any(finding.impossible for finding in implausibilities(few))
