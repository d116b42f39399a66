"""Checks a set of pushes against the physics of quasi-static pushing.

Two facts hold for every flat face, whatever its friction: while the tip stays on the face, the
face moves along its normal as far as the tip does, dx - p_y dtheta = d sin(beta); and the motion
cone of an ellipsoidal limit surface explains most of the motion. Data with a wrong unit, sign or
frame break one or both, and fit again when the mistake is undone. So every known mistake is
undone in turn, and the one that improves the fit decisively is named.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from push_core.common import InputError
from push_core.data.push_set import HALF_FACE, P_Y_LIMIT, PushSet
from push_core.geometry import Array
from push_core.physics import MotionCone, Slider

FRICTIONS = (0.05, 0.1, 0.2, 0.3, 0.5, 0.8)
SUPPORT_RADII = (0.02, 0.025, 0.03, 0.035, 0.042, 0.05, 0.065)  # [m]
MOST_ROWS = 150  # that are compared; more add nothing but time
DECISIVE, NOTICEABLE = 2.5, 1.4  # ratio of the misfits as given and with a mistake undone
ENOUGH = 8  # pushes from which a wrong sign or frame is distinguishable from noise
STILL = 0.02  # median motion in units of the distance; less is no motion
TORN = 1.0  # residual of the normal motion, in units of the distance, that no contact leaves
UNEXPLAINED = 0.5  # share of the motion from which a set is odd
EXPLAINED = 0.35  # share of the motion that a mistake, undone, may leave unexplained
CAP = 9.0  # of the squared residual of a push, in squared distances: bounds single faults
SUSPICIOUS = 0.05  # unexplained share of the motion from which a noticeable mistake is named


@dataclass(frozen=True)
class Finding:
    """A contradiction to the physics of pushing.

    Attributes:
        impossible: whether a set with it is refused; otherwise it is only odd.
        text: which column, in which way, by how much.
    """

    impossible: bool
    text: str


def check_plausible(pushes: PushSet, place: str, *, force: bool = False) -> list[str]:
    """Checks a set and returns warnings, each one line.

    Args:
        pushes: the set.
        place: where it comes from, for the messages.
        force: whether to accept what is impossible.

    Raises:
        InputError: the set contradicts the physics of pushing; not with `force`.
    """
    findings = list(implausibilities(pushes))
    worst = [finding.text for finding in findings if finding.impossible]
    if worst and not force:
        raise InputError(f'{place}: {worst[0]}')
    return [f'{place}: {finding.text}' for finding in findings]


def implausibilities(pushes: PushSet) -> Iterator[Finding]:
    """What contradicts the physics of pushing, the worst first."""
    few = _Pushes.of(pushes)
    if few.median_motion < STILL:
        yield Finding(True, 'the object did not move in these pushes (dx_m, dy_m and dtheta_rad)')
        return
    mistake = _mistake(few)
    if mistake:
        yield mistake
    else:
        yield from _odd_rows(pushes)


@dataclass(frozen=True)
class _Pushes:
    """Some pushes, and what a grid of motion cones predicts for them.

    Attributes:
        p_y: (n,) [m].
        beta: (n,) [rad].
        motion: (n, 3) displacements [m, m, rad].
        distance: of the tip [m].
        rates: (cones, n, 3) displacements per distance.
    """

    p_y: Array
    beta: Array
    motion: Array
    distance: float
    rates: Array

    @classmethod
    def of(cls, pushes: PushSet) -> '_Pushes':
        rows = np.unique(np.linspace(0, len(pushes) - 1, MOST_ROWS).astype(int))
        p_y, beta = pushes.p_y[rows], pushes.beta[rows]
        return cls(p_y, beta, pushes.displacement[rows], pushes.distance, _rates(p_y, beta))

    def moved(self, p_y: Array, beta: Array) -> '_Pushes':
        """The same motion at other inputs."""
        return _Pushes(p_y, beta, self.motion, self.distance, _rates(p_y, beta))

    @property
    def median_motion(self) -> float:
        """Median motion in units of the distance, a turn counted at the ends of the face."""
        scaled = self.motion * _UNIT / self.distance
        return float(np.median(np.linalg.norm(scaled, axis=1)))

    @property
    def normal_residual(self) -> Array:
        """(n,) normal motion of the face less that of the tip, in units of the distance."""
        face = self.motion[:, 0] - self.p_y * self.motion[:, 2]
        return np.asarray(face / self.distance - np.sin(self.beta))

    @property
    def misfits(self) -> Array:
        """(cones,) mean squared residuals in units of the distance."""
        residual = (self.motion / self.distance - self.rates) * _UNIT
        return np.asarray(np.mean(np.minimum(np.sum(residual**2, axis=2), CAP), axis=1))

    @property
    def misfit(self) -> float:
        """That of the best cone."""
        return float(self.misfits.min())

    @property
    def size(self) -> float:
        """Mean squared motion in units of the distance."""
        scaled = self.motion * _UNIT / self.distance
        return float(np.mean(np.minimum(np.sum(scaled**2, axis=1), CAP)))


def _rates(p_y: Array, beta: Array) -> Array:
    """(cones, n, 3) displacement rates [1, 1, rad/m] of a coarse grid of motion cones."""
    sliders = (
        Slider(friction_pusher=friction, support_radius=radius)
        for friction in FRICTIONS
        for radius in SUPPORT_RADII
    )
    return np.stack([MotionCone(slider).evaluate(p_y, beta)[0] for slider in sliders])


def _mistake(given: _Pushes) -> Finding | None:
    """The known mistake that explains the data decisively better than the data as they are."""
    misfit = given.misfit
    text, best = '', misfit
    for hypothesis in _hypotheses(given):
        left = hypothesis.undone.misfit
        if left < EXPLAINED * hypothesis.undone.size and left * hypothesis.handicap < best:
            text, best = hypothesis.text, left * hypothesis.handicap
    enough = len(given.p_y) >= ENOUGH
    ratio = misfit / max(best, 1e-6)
    share = misfit / given.size
    if text and ratio > DECISIVE and (enough or misfit > TORN):
        return Finding(True, f'{text} (these pushes contradict quasi-static pushing)')
    if np.median(np.abs(given.normal_residual)) > TORN:
        return Finding(
            True, 'the object moves farther than the tip that pushes it; check units and columns'
        )
    if text and ratio > NOTICEABLE and share > SUSPICIOUS and enough:
        return Finding(False, f'{text}? They would then fit quasi-static pushing better')
    if enough and share > UNEXPLAINED:
        return Finding(
            False, f'{100.0 * share:.0f} % of the motion is not explained by quasi-static pushing'
        )
    return None


def _odd_rows(pushes: PushSet) -> Iterator[Finding]:
    """Single pushes whose face did not move with the tip."""
    face = pushes.displacement[:, 0] - pushes.p_y * pushes.displacement[:, 2]
    odd = np.flatnonzero(np.abs(face / pushes.distance - np.sin(pushes.beta)) > TORN)
    if odd.size:
        rows = ', '.join(str(row + 1) for row in odd[:5]) + (', …' if odd.size > 5 else '')
        yield Finding(
            False,
            f'{odd.size} of {len(pushes)} pushes move the object farther than the tip '
            f'(push {rows})',
        )


@dataclass(frozen=True)
class _Hypothesis:
    """A mistake.

    Attributes:
        text: its name and the mend.
        undone: the pushes without it.
        handicap: factor on the misfit, above 1 for a mistake with a free parameter.
    """

    text: str
    undone: _Pushes
    handicap: float = 1.0


_UNIT = np.array([1.0, 1.0, HALF_FACE])
_LENGTHS = (
    (1000.0, 'millimetres'),
    (100.0, 'centimetres'),
    (10.0, 'ten times too large'),
    (39.37, 'inches'),
    (0.1, 'ten times too small'),
    (0.01, 'a hundred times too small'),
    (0.001, 'kilometres'),
)
_ANGLES = (
    (180.0 / np.pi, 'degrees'),
    (np.pi / 180.0, 'radians converted twice'),
    (1000.0, 'milliradians'),
    (0.5 / np.pi, 'revolutions'),
)
_SIGNS = (
    ((1, 1, -1), 'dtheta_rad has the other sign (counter-clockwise is positive)'),
    ((1, -1, 1), 'dy_m has the other sign (y points to the left of the push)'),
    ((-1, 1, 1), 'dx_m has the other sign (x points from the face inwards)'),
    ((-1, -1, 1), 'dx_m and dy_m have the other sign'),
)


def _hypotheses(given: _Pushes) -> Iterator[_Hypothesis]:
    yield from _units(given)
    for signs, text in _SIGNS:
        yield _Hypothesis(text, replace(given, motion=given.motion * signs))
    yield _Hypothesis('p_y_m has the other sign', given.moved(-given.p_y, given.beta))
    yield _Hypothesis(
        'beta_rad is mirrored: pi - beta_rad fits', given.moved(given.p_y, np.pi - given.beta)
    )
    exchanged = given.motion[:, [1, 0, 2]]
    yield _Hypothesis('dx_m and dy_m are exchanged', replace(given, motion=exchanged))
    for signs in ((-1, 1, 1), (1, -1, 1)):
        yield _Hypothesis(
            'dx_m and dy_m are exchanged, one with the other sign',
            replace(given, motion=exchanged * signs),
        )
    yield from _other_frames(given)


def _units(given: _Pushes) -> Iterator[_Hypothesis]:
    for factor, unit in _LENGTHS:
        mend = f'look like {unit}: {_mend(factor)}'
        for columns, scale in (
            ('dx_m and dy_m', (1, 1, 0)),
            ('dx_m', (1, 0, 0)),
            ('dy_m', (0, 1, 0)),
        ):
            motion = given.motion / np.where(scale, factor, 1.0)
            yield _Hypothesis(f'values of {columns} {mend}', replace(given, motion=motion))
        yield _Hypothesis(
            f'values of distance_m {mend}', replace(given, distance=given.distance / factor)
        )
        if np.abs(given.p_y / factor).max() <= P_Y_LIMIT:
            undone = given.moved(given.p_y / factor, given.beta)
            yield _Hypothesis(f'values of p_y_m {mend}', undone)
    for factor, unit in _ANGLES:
        motion = given.motion / [1.0, 1.0, factor]
        text = f'values of dtheta_rad look like {unit}: {_mend(factor)}'
        yield _Hypothesis(text, replace(given, motion=motion))


def _mend(factor: float) -> str:
    return f'divide by {factor:.4g}' if factor > 1.0 else f'multiply by {1.0 / factor:.4g}'


def _other_frames(given: _Pushes) -> Iterator[_Hypothesis]:
    """Displacements in a frame that is turned against the body, by one angle or by any."""
    sizes = np.abs(given.rates[:, :, 0] + 1j * given.rates[:, :, 1])
    measured = given.motion[:, 0] + 1j * given.motion[:, 1]
    turn_fits = (given.motion[:, 2] / given.distance - given.rates[:, :, 2]) * HALF_FACE
    fits = (np.abs(measured) / given.distance - sizes) ** 2 + turn_fits**2
    model = given.rates[int(np.argmin(np.minimum(fits, CAP).mean(axis=1)))]
    turns = measured * np.conj(model[:, 0] + 1j * model[:, 1])
    common = np.angle(turns.sum())
    text = f'dx_m and dy_m are in a frame that is turned by {np.degrees(common):.0f} degrees'
    yield _Hypothesis(text, _turned_back(given, measured, common), 1.2)
    text = 'dx_m and dy_m are not in the body frame (world frame?)'
    yield _Hypothesis(text, _turned_back(given, measured, np.angle(turns)), 4.0)


def _turned_back(given: _Pushes, measured: NDArray[np.complex128], angle: Array) -> _Pushes:
    back = measured * np.exp(-1j * angle)
    return replace(given, motion=np.column_stack((back.real, back.imag, given.motion[:, 2])))
