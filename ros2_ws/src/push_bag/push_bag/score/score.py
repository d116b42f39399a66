"""The score of a run: one JSON object.

Formulas: tracking.py, contact.py, timing.py, message_counts.py. `completed`: the controller
reached mode DONE without a stop, no other publisher commanded the tip, and the end of the run
satisfies `push_core.tracks.is_completed`.
A figure that a run does not have is None; `reasons` says why.
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from push_core.common import InputError, finite
from push_core.physics import LIMIT_NAMES
from push_core.tracks import is_completed
from push_msgs.msg import ControllerState
from push_node import interface
from push_node.endpoints import short_name

from push_bag.run import Floats, Reference, RunSeries, read_starts
from push_bag.score.contact import contact, loss_intervals
from push_bag.score.laps import per_lap
from push_bag.score.message_counts import foreign_commands, message_counts
from push_bag.score.prediction import prediction
from push_bag.score.reasons import left_out, other_topics, reasons
from push_bag.score.timing import pauses, timing
from push_bag.score.tracking import (
    Tracking,
    during_tracking,
    tracking_errors,
    true_tracking_errors,
)

LIMITS = {name: bit for bit, name in LIMIT_NAMES.items()}

STILL = 1e-3  # [m] of a reference; one that moves less leads nowhere


def score_run(folder: Path) -> dict[str, Any]:
    """The score of a recorded run.

    Args:
        folder: run folder or MCAP file; an unfinished one is scored as far as it goes.

    Returns:
        The object that `score --json` prints; None where a run has no such figure.

    Raises:
        InputError: there is no readable bag, or no reference in it.
    """
    return bag_score([score_series(start) for start in read_starts(folder)])


def bag_score(starts: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """The score of a bag: that of its last start, with a list of all where there are several.

    Args:
        starts: the scores of the starts in the bag, in order; at least one.
    """
    return starts[-1] | ({'starts': list(starts)} if len(starts) > 1 else {})


def score_series(run: RunSeries) -> dict[str, Any]:
    """The score of a run as `read_run` returns it.

    Raises:
        InputError: the run holds no reference to score it against.
    """
    if run.reference is None:
        others = other_topics(run.types, interface.NOMINAL_TRAJECTORY)
        raise InputError(
            f'the bag holds no nominal trajectory, so there is nothing to score{others}'
        )
    tracking, truth = tracking_errors(run, run.reference), true_tracking_errors(run, run.reference)
    score = {
        **_verdict(run, run.reference, truth or tracking),
        **_setting(run, run.reference),
        **_errors(tracking),
        'truth': None if truth is None else _distances(truth),
        'per_lap': per_lap(run.reference, tracking, truth, run.lessons),
        **_times(run),
        'contact_losses': contact_losses(run, run.reference),
        'holds': holds(run),
        'pauses': pauses(run),
        'limited': limited(run),
        'prediction': prediction(run),
        'messages': message_counts(run),
        'left_out': left_out(run),
        'parameter_changes': parameter_changes(run),
    }
    score['reasons'] = reasons(run, score)
    without_nan: dict[str, Any] = finite(score)
    return without_nan


def completed(run: RunSeries, reference: Reference, tracking: Tracking) -> bool | None:
    """Whether the run was completed, see `push_core.tracks.is_completed`; None if unknown.

    Judged by the true poses where they were recorded.
    """
    if foreign_commands(run):
        return False
    modes = run.state('mode')
    arrived, stopped = ControllerState.DONE in modes, ControllerState.STOPPED in modes
    if modes.size and (stopped or not arrived):
        return False
    if np.ptp(reference.pose[:, :2], axis=0).max() < STILL:
        return False
    touching = contact(run, reference)
    if not tracking.stamp.size or not touching.stamp.size:
        return None
    return is_completed(
        arrived=True,
        distance=float(np.hypot(*(tracking.pose[-1, :2] - reference.pose[-1, :2]))),
        gap=float(touching.gap[-1]),
        contact_offset=float(touching.p_y[-1]),
        side=reference.side,
    )


def contact_losses(run: RunSeries, reference: Reference) -> int | None:
    """How often the tip lost contact; None if its position on the face is never known."""
    touching = contact(run, reference)
    return len(loss_intervals(touching)) if touching.stamp.size else None


def limited(run: RunSeries) -> dict[str, int] | None:
    """Number of ticks during tracking in which each limit changed the command.

    None without ticks.
    """
    if not run.states.stamp.size:
        return None
    bits = run.state('limited')[run.following].astype(np.int64)
    return {name: int(np.count_nonzero(bits & bit)) for name, bit in LIMITS.items()}


def holds(run: RunSeries) -> int | None:
    """How often the controller stood still because it had no fresh pose; None without ticks."""
    if not run.states.stamp.size:
        return None
    holding = run.state('mode') == ControllerState.HOLDING
    return int(np.count_nonzero(np.diff(np.concatenate([[False], holding]).astype(np.int8)) > 0))


def parameter_changes(run: RunSeries) -> list[dict[str, Any]]:
    """Time after the first tick [s], node and values of each change of parameters.

    Changes before the run, which are in effect too, have negative times.
    """
    ticks = run.states.published
    first = int(ticks[0]) if ticks.size else 0
    return [
        {
            'time_s': (change.published - first) * 1e-9,
            'node': change.node.rpartition('/')[2],
            'parameters': dict(change.values),
        }
        for change in run.changes
    ]


def _verdict(run: RunSeries, reference: Reference, tracking: Tracking) -> dict[str, Any]:
    last = tracking.reference_time[-1] if tracking.stamp.size else math.nan
    return {
        'completed': completed(run, reference, tracking),
        'stop_reason': run.stop_reason or None,
        'bag_finished': run.finished,
        'recovered_from': run.facts.get('recovered_from'),
        'duration_s': float(np.minimum(last, reference.duration)),
    }


def _setting(run: RunSeries, reference: Reference) -> dict[str, Any]:
    return {
        'track': reference.track,
        'laps': reference.laps,
        'learn': bool(run.lessons),
        'speed_m_s': reference.speed,
        'controller': reference.controller,
        'profile': run.facts.get('profile'),
        'mode': run.facts.get('mode'),
        'seed': _seed(run.facts.get('seed')),
        'changed': run.facts.get('changed') or None,
        'model': _model(run),
    }


def _seed(text: str | None) -> int | str | None:
    return int(text) if text is not None and text.lstrip('-').isdigit() else text


def _model(run: RunSeries) -> dict[str, Any] | None:
    if run.model is None:
        return None
    return {'points': run.model.points, 'hash': run.model.hash, 'kind': run.model.kind}


def _errors(tracking: Tracking) -> dict[str, Any]:
    cross = tracking.cross_track * 1e3
    heading = np.abs(np.degrees(tracking.heading[np.isfinite(tracking.heading)]))
    return {
        'tracking_error_mm': _distances(tracking),
        'cross_track_mm': {'mean': _mean(cross), 'rms': _rms(cross), 'max': _max(np.abs(cross))},
        'heading_error_deg': {
            'mean': _mean(heading),
            'rms': _rms(heading),
            'max': _max(heading),
        },
    }


def _distances(tracking: Tracking) -> dict[str, float]:
    distance = tracking.distance * 1e3
    return {
        'mean': _mean(distance),
        'rms': _rms(distance),
        'p95': _percentile(distance, 95.0),
        'max': _max(distance),
        'mean_after_start': _mean(distance[tracking.after_start]),
    }


def _times(run: RunSeries) -> dict[str, Any]:
    times = timing(run)
    return {
        'solve_ms': _tail(times.solve),
        'tick_ms': _tail(times.tick),
        'pose_to_command_ms': _tail(times.pose_to_command),
        'deadline_misses': times.deadline_misses if _knows_commands(run) else None,
    }


def _knows_commands(run: RunSeries) -> bool:
    """Whether poses during tracking and the topic of the commands were recorded."""
    recorded = {short_name(name) for name in run.types}
    during = during_tracking(run, run.object.stamp).any()
    return bool(during) and interface.PUSHER_VELOCITY_CMD.short_name in recorded


def _tail(values: Floats) -> dict[str, float]:
    return {
        'p50': _percentile(values, 50.0),
        'p99': _percentile(values, 99.0),
        'p999': _percentile(values, 99.9),
        'max': _max(values),
    }


def _mean(values: Floats) -> float:
    return float(np.mean(values)) if values.size else math.nan


def _rms(values: Floats) -> float:
    return float(np.sqrt(np.mean(values**2))) if values.size else math.nan


def _max(values: Floats) -> float:
    return float(np.max(values)) if values.size else math.nan


def _percentile(values: Floats, percent: float) -> float:
    return float(np.percentile(values, percent)) if values.size else math.nan
