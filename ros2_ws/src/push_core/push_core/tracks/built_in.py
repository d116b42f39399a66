"""The built-in tracks, and tracks by name."""

import math
from pathlib import Path

from push_core.common import InputError
from push_core.tracks.arc_track import ArcTrack
from push_core.tracks.track import Track

EIGHT_RADIUS = 0.15
SQUARE_RADIUS = 0.08
SQUARE_STRAIGHT = 0.24
LINE_LENGTH = 0.5
"""[m]"""


def eight() -> Track:
    """The paper's 8-track: two circles of radius 150 mm that touch at the origin."""
    circle = 2.0 * math.pi * EIGHT_RADIUS
    pieces = [(circle, 1.0 / EIGHT_RADIUS), (circle, -1.0 / EIGHT_RADIUS)]
    return ArcTrack('eight', pieces, heading=math.pi / 2.0, closed=True)


def square() -> Track:
    """The paper's square: straight lines joined by quarter circles of radius 80 mm."""
    corner = (0.5 * math.pi * SQUARE_RADIUS, 1.0 / SQUARE_RADIUS)
    half_side = (0.5 * SQUARE_STRAIGHT, 0.0)
    pieces = [half_side, corner, half_side] * 4
    return ArcTrack('square', pieces, heading=0.0, closed=True)


def line() -> Track:
    """A straight line of 0.5 m from the origin along x."""
    return ArcTrack('line', [(LINE_LENGTH, 0.0)], heading=0.0, closed=False)


def circle() -> Track:
    """The left circle of the 8-track."""
    pieces = [(2.0 * math.pi * EIGHT_RADIUS, 1.0 / EIGHT_RADIUS)]
    return ArcTrack('circle', pieces, heading=math.pi / 2.0, closed=True)


TRACKS = {'eight': eight, 'square': square, 'line': line, 'circle': circle}


def by_name(name: str) -> Track:
    """The built-in track of that name, or the one in the CSV file of that path.

    Raises:
        InputError: neither a known name nor a readable CSV file.
    """
    if name in TRACKS:
        return TRACKS[name]()
    if name.lower().endswith('.csv'):
        # scipy takes a third of a second to import
        from push_core.tracks.track_csv import read_track  # noqa: PLC0415

        return read_track(Path(name))
    raise InputError(f'unknown track {name!r}; use {", ".join(TRACKS)} or a .csv file of x, y')
