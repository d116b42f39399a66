"""Errors of the object against its reference.

For every pose recorded during tracking (modes TRACKING and RECONTACT) the controller states give
the reference time of its exposure:
    tracking error = |position(t) - reference position(reference time)|, the paper's metric;
    cross-track error = signed distance to the nearest point of the reference path near that time,
        positive to the left of the path; the path is extended by straight lines;
    heading error = heading(t) - reference heading(reference time), wrapped.
Poses count where 0 < reference time <= the reference's duration and the position is a number; the
heading of a pose may be unknown (NaN).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from push_core.geometry import wrap_angles

from push_bag.run import Floats, Nanoseconds, Reference, RunSeries, Stamped
from push_bag.score.segments import Segments

NEAR = 0.06  # [m] of path before and after, in which the nearest point is searched
START_SHARE = 0.1  # of the reference, excluded by `after_start`
TIME_ROUNDING = 1e-9  # [s] by which rounding may put the last sample after the end


@dataclass(frozen=True)
class Tracking:
    """Errors at each pose that counts, in order of time.

    Attributes:
        stamp: (n,) of the poses [ns].
        reference_time: (n,) [s].
        pose: (n, 3) measured, or true [m, m, rad].
        reference: (n, 3) reference pose at the reference time [m, m, rad].
        distance: (n,) tracking error [m].
        cross_track: (n,) [m].
        heading: (n,) heading error [rad] in [-pi, pi); NaN where the heading is unknown.
        after_start: (n,) whether the pose comes after the first tenth of the reference.
    """

    stamp: Nanoseconds
    reference_time: Floats
    pose: Floats
    reference: Floats
    distance: Floats
    cross_track: Floats
    heading: Floats
    after_start: NDArray[np.bool_]


def tracking_interval(run: RunSeries) -> tuple[int, int] | None:
    """First and last stamp [ns] of the ticks during tracking; None without any."""
    stamps = run.states.stamp[run.following]
    return (int(stamps[0]), int(stamps[-1])) if stamps.size else None


def during_tracking(run: RunSeries, stamps: Nanoseconds) -> NDArray[np.bool_]:
    """Whether each of the stamps (n,) lies in the tracking interval."""
    interval = tracking_interval(run)
    if interval is None:
        return np.zeros(stamps.size, np.bool_)
    return (stamps >= interval[0]) & (stamps <= interval[1])


def reference_times(run: RunSeries, stamps: Nanoseconds) -> Floats:
    """Reference time (n,) [s] at each of the stamps (n,) during tracking; NaN where unknown."""
    ticks = run.following & np.isfinite(run.state('reference_time'))
    if not ticks.any():
        return np.full(stamps.size, np.nan)
    known = run.states.stamp[ticks]
    # differences of stamps: a float64 of the stamps themselves would round to 0.2 us
    times: Floats = np.interp(
        (stamps - known[0]).astype(np.float64),
        (known - known[0]).astype(np.float64),
        run.state('reference_time')[ticks],
        left=np.nan,
        right=np.nan,
    )
    return times


def tracking_errors(run: RunSeries, reference: Reference) -> Tracking:
    """The errors of the measured poses of a run against its reference."""
    return _tracking(run, reference, run.object)


def true_tracking_errors(run: RunSeries, reference: Reference) -> Tracking | None:
    """The errors of the true poses of a run against its reference; None without ground truth."""
    return _tracking(run, reference, run.truth) if run.truth.stamp.size else None


def _tracking(run: RunSeries, reference: Reference, poses: Stamped) -> Tracking:
    tracked = during_tracking(run, poses.stamp) & np.isfinite(poses.values[:, :2]).all(axis=1)
    stamp, pose = poses.stamp[tracked], poses.values[tracked]
    time = reference_times(run, stamp) if stamp.size else np.zeros(0)
    counts = (time > 0.0) & (time <= reference.duration + TIME_ROUNDING)
    stamp, pose, time = stamp[counts], pose[counts], time[counts]
    target = reference.pose_at(time)
    return Tracking(
        stamp=stamp,
        reference_time=time,
        pose=pose,
        reference=target,
        distance=np.hypot(*(pose[:, :2] - target[:, :2]).T),
        cross_track=cross_track(reference, pose[:, :2], time),
        heading=wrap_angles(pose[:, 2] - target[:, 2]),
        after_start=time > START_SHARE * reference.duration,
    )


def cross_track(reference: Reference, points: Floats, time: Floats) -> Floats:
    """Signed distance (n,) [m] of points (n, 2) to the path near reference times (n,) [s]."""
    period = reference.duration / (reference.time.size - 1)
    here = np.clip((time / period).astype(np.intp), 0, reference.time.size - 2)
    reach = int(np.ceil(NEAR / max(reference.speed * period, 1e-6)))
    segments = Segments.of(reference.pose[:, :2])
    nearest = np.full(time.size, np.inf)
    for shift in range(-min(reach, reference.time.size), min(reach, reference.time.size) + 1):
        signed = segments.distance(np.clip(here + shift, 0, reference.time.size - 2), points)
        nearest = np.where(np.abs(signed) < np.abs(nearest), signed, nearest)
    return nearest
