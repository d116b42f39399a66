"""Tracks: paths of the object by arc length, built in or read from CSV."""

from push_core.tracks.completion import is_completed
from push_core.tracks.track import TRACKS, ArcTrack, Track, by_name

__all__ = ['TRACKS', 'ArcTrack', 'Track', 'by_name', 'is_completed']
