"""Tracks: paths of the object by arc length, built in or read from CSV, and their parts."""

from push_core.tracks.arc_track import ArcTrack
from push_core.tracks.built_in import TRACKS, by_name
from push_core.tracks.completion import is_completed
from push_core.tracks.parts import PIECE, Parts
from push_core.tracks.track import Track

__all__ = ['PIECE', 'TRACKS', 'ArcTrack', 'Parts', 'Track', 'by_name', 'is_completed']
