"""Why a score lacks a figure or a run does not count, and how many poses are left out."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from push_core.common import finite
from push_node import interface
from push_node.endpoints import GraphTopic, short_name

from push_bag.run import RunSeries, Stamped
from push_bag.score.message_counts import foreign_commands
from push_bag.score.timing import WITHOUT_MIDDLEWARE
from push_bag.score.tracking import during_tracking, tracking_interval


def left_out(run: RunSeries) -> dict[str, dict[str, int]]:
    """Poses that no figure uses, by topic; empty where all poses are used.

    `not_finite` have a position that is no number, `no_heading` an orientation that is no unit
    quaternion or lies on its side; the others are used.
    """
    counts = {
        topic.short_name: _left_out(rows)
        for topic, rows in (
            (interface.OBJECT_POSE, run.object),
            (interface.PUSHER_POSE, run.pusher),
            (interface.GROUND_TRUTH, run.truth),
        )
    }
    return {
        name: each for name, each in counts.items() if each['not_finite'] or each['no_heading']
    }


def reasons(run: RunSeries, score: Mapping[str, Any]) -> dict[str, str]:
    """Why each figure is missing that the score lacks, by its name in the score.

    `completed` has a reason, too, if another publisher commanded the tip.

    Args:
        run: that was scored.
        score: its figures.
    """
    missing = {name: reason(run) for name, reason in REASONS.items() if _is_missing(score[name])}
    return missing | _of_foreign_commands(run)


def topic_reason(types: Mapping[str, str], topic: GraphTopic) -> str:
    """Why there is no message of a topic.

    Args:
        types: names of the message types in the bag, by topic.
        topic: that is missing.
    """
    there = [name for name in types if short_name(name) == topic.short_name]
    if there:
        return f'the bag holds no message on {there[0]}'
    return f'the bag holds no topic {topic.short_name}{other_topics(types, topic)}'


def other_topics(types: Mapping[str, str], topic: GraphTopic) -> str:
    """The topics that may be the missing one under another name; empty without any."""
    own = {each.short_name for each in interface.TOPICS}
    strange = sorted(
        name
        for name, kind in types.items()
        if kind == topic.type_name and short_name(name) not in own
    )
    return f'; of its type {topic.type_name} it holds {", ".join(strange)}' if strange else ''


def _is_missing(value: Any) -> bool:
    if isinstance(value, Mapping):
        values = list(value.values())
        return bool(values) and all(each is None for each in finite(values))
    return value is None or (isinstance(value, float) and math.isnan(value))


def _of_foreign_commands(run: RunSeries) -> dict[str, str]:
    count = foreign_commands(run)
    if not count:
        return {}
    return {
        'completed': f'{count} commands of another publisher on '
        f'{interface.PUSHER_VELOCITY_CMD.short_name}: they answer no tick of the controller'
    }


def _of_errors(run: RunSeries) -> str:
    return (
        _pose_reason(run, interface.OBJECT_POSE)
        or _clock_reason(run)
        or 'no pose lies within the time of the reference: the run ended before it began'
    )


def _of_heading(run: RunSeries) -> str:
    return _pose_reason(run, interface.OBJECT_POSE) or _heading_reason(run) or _of_errors(run)


def _of_truth(run: RunSeries) -> str:
    if not run.truth.stamp.size:
        return 'the bag holds no ground truth'
    return _pose_reason(run, interface.GROUND_TRUTH) or _of_errors(run)


def _of_contact(run: RunSeries) -> str:
    return (
        _pose_reason(run, interface.OBJECT_POSE)
        or _heading_reason(run)
        or _pose_reason(run, interface.PUSHER_POSE)
        or f'no message on {interface.PUSHER_POSE.short_name} is within 5 ms of an object pose'
    )


def _of_times(run: RunSeries) -> str:
    return _interval_reason(run) or 'the run states no times of the controller'


def _of_commands(run: RunSeries) -> str:
    mode = run.facts.get('mode')
    if mode in WITHOUT_MIDDLEWARE:
        return f'not measured in a run of mode {mode}: it has no middleware'
    reason = _pose_reason(run, interface.OBJECT_POSE)
    if not reason and not run.commands.stamp.size:
        return topic_reason(run.types, interface.PUSHER_VELOCITY_CMD)
    return reason or 'no command has the stamp of a pose'


def _of_misses(run: RunSeries) -> str:
    return _pose_reason(run, interface.OBJECT_POSE) or topic_reason(
        run.types, interface.PUSHER_VELOCITY_CMD
    )


def _of_ticks(run: RunSeries) -> str:
    return topic_reason(run.types, interface.CONTROLLER_STATE)


def _of_prediction(run: RunSeries) -> str:
    if not run.states.stamp.size:
        return _of_ticks(run)
    return 'too few ticks state how well they predict the next pose'


def _of_model(run: RunSeries) -> str:
    return topic_reason(run.types, interface.MODEL_INFO)


REASONS: Mapping[str, Callable[[RunSeries], str]] = {
    'completed': _of_contact,
    'duration_s': _of_errors,
    'tracking_error_mm': _of_errors,
    'cross_track_mm': _of_errors,
    'heading_error_deg': _of_heading,
    'truth': _of_truth,
    'model': _of_model,
    'contact_losses': _of_contact,
    'solve_ms': _of_times,
    'tick_ms': _of_times,
    'pose_to_command_ms': _of_commands,
    'deadline_misses': _of_misses,
    'holds': _of_ticks,
    'pauses': _of_ticks,
    'limited': _of_ticks,
    'prediction': _of_prediction,
}
"""Figures that a run can lack, and why it does."""


def _pose_reason(run: RunSeries, topic: GraphTopic) -> str:
    """Why there is no pose of a topic during tracking; empty if there is one."""
    rows = _rows(run, topic)
    if not rows.stamp.size:
        return topic_reason(run.types, topic)
    usable = np.isfinite(rows.values[:, :2]).all(axis=1)
    if not usable.any():
        return f'no pose on {topic.short_name} is a number (all {usable.size} are NaN)'
    interval = tracking_interval(run)
    if interval is None:
        return _interval_reason(run)
    if not (usable & during_tracking(run, rows.stamp)).any():
        away = (int(rows.stamp[0]) - interval[0]) * 1e-9
        return (
            f'no pose on {topic.short_name} is stamped while the controller followed the '
            f'reference; the first one comes {away:+.3f} s after that began'
        )
    return ''


def _interval_reason(run: RunSeries) -> str:
    if not run.states.stamp.size:
        return topic_reason(run.types, interface.CONTROLLER_STATE)
    if tracking_interval(run) is None:
        return 'the controller never followed the reference (mode TRACKING)'
    return ''


def _clock_reason(run: RunSeries) -> str:
    known = np.isfinite(run.state('reference_time')[run.following])
    return '' if known.any() else 'the controller states no reference time while it follows'


def _heading_reason(run: RunSeries) -> str:
    """Why no heading of the object is known; empty if one is."""
    if np.isfinite(run.object.values[:, 2]).any():
        return ''
    return (
        f'no orientation on {interface.OBJECT_POSE.short_name} is a unit quaternion of an upright '
        f'object (0 of {run.object.stamp.size}); does the driver set it?'
    )


def _rows(run: RunSeries, topic: GraphTopic) -> Stamped:
    return {
        interface.OBJECT_POSE.short_name: run.object,
        interface.PUSHER_POSE.short_name: run.pusher,
        interface.GROUND_TRUTH.short_name: run.truth,
    }[topic.short_name]


def _left_out(rows: Stamped) -> dict[str, int]:
    position = np.isfinite(rows.values[:, :2]).all(axis=1)
    heading = np.isfinite(rows.values[:, 2:]).all(axis=1)
    return {
        'of': int(rows.stamp.size),
        'not_finite': int(np.count_nonzero(~position)),
        'no_heading': int(np.count_nonzero(position & ~heading)),
    }
