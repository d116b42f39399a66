import math

import numpy as np
import pytest
from push_core.common.errors import InputError
from push_core.tracks import built_in as tracks
from push_core.tracks.arc_track import ArcTrack
from push_core.tracks.track_csv import read_track

PI = math.pi
CLOSED = ['eight', 'square']


@pytest.fixture(params=['eight', 'square', 'line', 'circle'])
def track(request, circle_csv):
    name = request.param
    return read_track(circle_csv) if name == 'circle' else tracks.by_name(name)


def places(track, count=5001):
    """Arc lengths (n,) that keep clear of the jumps of the curvature."""
    s = np.linspace(0.0, track.length, count)[1:-1]
    if not len(track.breakpoints):
        return s
    return s[np.abs(s[:, None] - track.breakpoints).min(axis=1) > 1e-4]


@pytest.mark.parametrize(
    ('name', 'length', 'turn'),
    [
        ('eight', 2 * 2 * PI * 0.15, 0.0),
        ('square', 4 * 0.24 + 2 * PI * 0.08, 2 * PI),
        ('line', 0.5, 0.0),
    ],
)
def test_length_and_turn_are_those_of_the_drawing(name, length, turn) -> None:
    track = tracks.by_name(name)
    assert track.length == pytest.approx(length, rel=1e-14)
    heading = track.at(np.array([0.0, track.length]))[2]
    assert heading[1] - heading[0] == pytest.approx(turn, abs=1e-12)


def test_the_eight_is_two_circles_of_150_mm_that_touch_at_the_origin() -> None:
    track = tracks.eight()
    x, y, _, curvature = track.at(np.linspace(0.0, track.length, 400, endpoint=False))
    centre = np.where(curvature > 0.0, -0.15, 0.15)
    assert np.hypot(x - centre, y) == pytest.approx(np.full(400, 0.15))


def test_the_square_has_straight_sides_and_quarter_circles_of_80_mm() -> None:
    track = tracks.square()
    x, y, _, curvature = track.at(np.linspace(0.0, track.length, 4000))
    assert set(curvature) == {0.0, 1.0 / 0.08}
    assert (np.ptp(x), np.ptp(y)) == pytest.approx((0.4, 0.4), abs=1e-6)


@pytest.mark.parametrize('name', CLOSED)
def test_a_closed_track_ends_where_and_how_it_began(name) -> None:
    track = tracks.by_name(name)
    before, after = 1e-9, track.length - 1e-9
    x, y, heading, _ = track.at(np.array([before, after]))
    assert track.closed
    assert (x[0], y[0]) == pytest.approx((x[1], y[1]), abs=1e-8)
    assert math.remainder(heading[1] - heading[0], 2 * PI) == pytest.approx(0.0, abs=1e-6)


def test_heading_and_curvature_are_the_derivatives_of_the_path(track) -> None:
    s, step = places(track), 1e-6
    (x0, y0, heading0, _), (x1, y1, heading1, _) = track.at(s - step), track.at(s + step)
    _, _, heading, curvature = track.at(s)
    along = np.stack([x1 - x0, y1 - y0]) / (2.0 * step)
    tolerance = 1e-8 if isinstance(track, ArcTrack) else 2e-4
    assert np.hypot(*along) == pytest.approx(np.ones(s.size), abs=tolerance)
    assert np.allclose(along, [np.cos(heading), np.sin(heading)], rtol=0, atol=tolerance)
    by_difference = (heading1 - heading0) / (2.0 * step)
    assert np.allclose(by_difference, curvature, rtol=2e-4, atol=1e-6)


@pytest.mark.parametrize('name', CLOSED)
def test_the_next_lap_goes_on_without_a_jump(name) -> None:
    track = tracks.by_name(name)
    s = np.linspace(0.7 * track.length, 2.3 * track.length, 20001)
    x, y, heading, curvature = track.at(s)
    step = s[1] - s[0]
    assert np.hypot(np.diff(x), np.diff(y)) == pytest.approx(np.full(20000, step), rel=1e-3)
    assert np.abs(np.diff(heading)).max() <= step * np.abs(curvature).max() * (1.0 + 1e-9)


def test_an_unknown_name_is_refused_with_those_that_exist() -> None:
    with pytest.raises(InputError, match=r"unknown track 'spiral'; use eight, square, line"):
        tracks.by_name('spiral')
