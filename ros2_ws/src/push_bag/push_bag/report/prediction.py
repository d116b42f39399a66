"""What the controller predicted against what came, and how the tip really moved.

    prediction error = distance from the predicted centre to the measured one of the same instant.
The controller predicts the instant at which its command takes effect. How far that is ahead
follows from the reference point that it names for that instant, and the speed of the reference.
"""

import numpy as np

from push_bag.run import Floats, Reference, RunSeries
from push_bag.score import during_tracking, reference_times

LONGEST_LEAD = 1.0  # [s]
SPAN = 2  # poses before and after, over which the tip's velocity is taken


def prediction_errors(run: RunSeries, reference: Reference) -> tuple[Floats, Floats]:
    """Reference times (n,) [s] of the predicted instants, and the errors (n,) [m] there."""
    time = run.state('reference_time')
    inside = run.following & (time > 0.0) & (time < reference.duration)
    stamp, time = run.states.stamp[inside], time[inside]
    there = _columns(run, 'predicted_reference_x', 'predicted_reference_y')[inside]
    lead = np.hypot(*(there - reference.pose_at(time)[:, :2]).T) / reference.speed
    predicted = _columns(run, 'predicted_x', 'predicted_y')[inside]
    known = np.isfinite(lead) & (lead < LONGEST_LEAD) & (time + lead <= reference.duration)
    at = (stamp[known] - run.object.stamp[:1].sum()) * 1e-9 + lead[known]
    came = _object_at(run, at)
    return time[known] + lead[known], np.hypot(*(predicted[known] - came).T)


def tip_velocities(run: RunSeries) -> tuple[Floats, Floats]:
    """Reference times (n,) [s], and the measured velocity [v_n, v_t] (n, 2) of the tip [m/s]."""
    index, exists = run.object.near(run.pusher.stamp)
    used = exists & during_tracking(run, run.pusher.stamp)
    stamp, tip, heading = (
        run.pusher.stamp[used],
        run.pusher.values[used],
        run.object.values[index[used], 2],
    )
    if stamp.size <= 2 * SPAN:
        return np.zeros(0), np.zeros((0, 2))
    seconds = (stamp[2 * SPAN :] - stamp[: -2 * SPAN])[:, None] * 1e-9
    v_x, v_y = ((tip[2 * SPAN :] - tip[: -2 * SPAN]) / seconds).T
    cos, sin = np.cos(heading[SPAN:-SPAN]), np.sin(heading[SPAN:-SPAN])
    velocity = np.column_stack([cos * v_x + sin * v_y, cos * v_y - sin * v_x])
    return reference_times(run, stamp[SPAN:-SPAN]), velocity


def disturbances(run: RunSeries) -> tuple[Floats, Floats]:
    """Reference times (n,) [s], and the estimated model errors (n, 3) per metre [1, 1, rad/m]."""
    names = ('disturbance_x', 'disturbance_y', 'disturbance_theta')
    ticks = run.following
    return run.state('reference_time')[ticks], _columns(run, *names)[ticks]


def _columns(run: RunSeries, *names: str) -> Floats:
    return np.column_stack([run.state(name) for name in names])


def _object_at(run: RunSeries, time: Floats) -> Floats:
    """Centre of the object (n, 2) [m] at times (n,) [s] after its first pose, linear between."""
    own = (run.object.stamp - run.object.stamp[:1].sum()) * 1e-9
    return np.column_stack([np.interp(time, own, each) for each in run.object.values[:, :2].T])
