"""The score of a run as text."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from push_core.common import plain_table

from push_bag.score.changes import changes_in_words

Row = tuple[str, str]


def score_table(score: Mapping[str, Any]) -> str:
    """The score as a table of names and values, then a line about lost messages."""
    lines = plain_table(score_rows(score), left=2)
    return '\n'.join([*lines, '', messages_line(score)]) + '\n'


def score_rows(score: Mapping[str, Any]) -> list[Row]:
    """Name and value of each line, with units."""
    rows = [
        ('completed', _verdict(score)),
        ('run', _run(score)),
        ('model', _known(score, 'model', _model)),
        ('duration', _known(score, 'duration_s', _seconds)),
        ('tracking error', _known(score, 'tracking_error_mm', _millimetres)),
        ('each lap', _laps(score['per_lap'])),
        ('identified', _identified(score['per_lap'])),
        ('error of the true pose', _known(score, 'truth', _millimetres)),
        ('cross-track error', _known(score, 'cross_track_mm', _millimetres)),
        ('heading error', _known(score, 'heading_error_deg', _degrees)),
        ('solve', _known(score, 'solve_ms', _milliseconds)),
        ('tick', _known(score, 'tick_ms', _milliseconds)),
        ('pose to command', _known(score, 'pose_to_command_ms', _milliseconds)),
        ('deadline misses', _known(score, 'deadline_misses', str)),
        ('holds', _known(score, 'holds', str)),
        ('pauses', _known(score, 'pauses', _pauses)),
        ('contact losses', _known(score, 'contact_losses', str)),
        ('limited ticks', _known(score, 'limited', _counts)),
        ('changed', _changed(score.get('parameter_changes', ()))),
        ('left out', _left_out(score['left_out'])),
        ('bag', _bag(score)),
    ]
    return [row for row in rows if row[1]]


def messages_lost(score: Mapping[str, Any]) -> int | None:
    """Number of lost messages on all topics; None where it is not known of one of them."""
    lost = [counts['lost'] for counts in score['messages'].values()]
    return None if None in lost else sum(lost)


def messages_line(score: Mapping[str, Any]) -> str:
    """A line such as `0 of 14130 messages lost`, with the topics that lost messages."""
    topics = score['messages']
    unknown = [name for name, counts in topics.items() if counts['lost'] is None]
    lost = {name: counts['lost'] for name, counts in topics.items() if counts['lost']}
    sent = sum(counts['received'] for name, counts in topics.items() if name not in unknown)
    named = ''.join(f'; {name} {count}' for name, count in lost.items())
    if unknown:
        named += f'; not known of {", ".join(unknown)}: no sequence numbers'
    return f'{sum(lost.values())} of {sent + sum(lost.values())} messages lost{named}'


def _known(score: Mapping[str, Any], name: str, text: Callable[[Any], str]) -> str:
    """The text of a figure, or why there is none."""
    reason = score['reasons'].get(name)
    return f'none: {reason}' if reason else text(score[name])


def _laps(laps: Sequence[Mapping[str, Any]]) -> str:
    """Mean error of each lap; empty for one lap."""
    means = '  '.join(_number(lap['mean_mm']) for lap in laps)
    return f'mean {means}  mm' if len(laps) > 1 else ''


def _identified(laps: Sequence[Mapping[str, Any]]) -> str:
    """What drove the last lap; empty if nothing was identified."""
    known = laps[-1]['identified'] if laps else None
    if known is None:
        return ''
    return (
        f'friction {known["friction"]:.3f} +- {known["friction_std"]:.3f}, support radius '
        f'{known["support_radius_mm"]:.2f} +- {known["support_radius_std_mm"]:.2f} mm'
    )


def _changed(changes: Sequence[Mapping[str, Any]]) -> str:
    """When which parameters changed; empty without a change."""
    return '; '.join(
        f'{change["time_s"]:.2f} s {change["node"]}.{name}={value}'
        for change in changes
        for name, value in change['parameters'].items()
    )


def _left_out(topics: Mapping[str, Mapping[str, int]]) -> str:
    """How many poses are not used; empty if all are."""
    texts = {'not_finite': 'not a number', 'no_heading': 'no unit quaternion or not upright'}
    return '; '.join(
        f'{counts[kind]} of {counts["of"]} on {name}: {text}'
        for name, counts in topics.items()
        for kind, text in texts.items()
        if counts[kind]
    )


def _bag(score: Mapping[str, Any]) -> str:
    if score['recovered_from']:
        return f'recovered from {score["recovered_from"]}; messages may be missing'
    return 'finished' if score['bag_finished'] else 'unfinished: the recording was cut short'


def _verdict(score: Mapping[str, Any]) -> str:
    if score['completed']:
        return 'yes'
    reason = score['reasons'].get('completed')
    if score['completed'] is None:
        return f'not known: {reason}'
    if reason:
        return f'no: {reason}'
    return f'no, stopped: {score["stop_reason"]}' if score['stop_reason'] else 'no'


def _run(score: Mapping[str, Any]) -> str:
    laps = f'{score["laps"]} lap' + ('s' if score['laps'] != 1 else '')
    words = [score['track'], f'{score["speed_m_s"] * 1e3:.4g} mm/s', laps, score['controller']]
    words += ['learning'] if score.get('learn') else []
    words += [score['profile'], score['mode']]
    seed = [] if score['seed'] is None else [f'seed {score["seed"]}']
    changes = changes_in_words(score.get('changed'))
    return ', '.join([word for word in words if word] + seed + changes)


def _model(model: Mapping[str, Any]) -> str:
    return f'{model["kind"]}, {model["points"]} pushes, {model["hash"][:12]}'


def _seconds(value: float) -> str:
    return f'{value:.2f} s'


def _millimetres(figures: Mapping[str, float | None]) -> str:
    return _figures(figures, 'mm')


def _degrees(figures: Mapping[str, float | None]) -> str:
    return _figures(figures, 'deg')


def _milliseconds(figures: Mapping[str, float | None]) -> str:
    return _figures(figures, 'ms')


def _figures(figures: Mapping[str, float | None], unit: str) -> str:
    named = (f'{name.replace("_", " ")} {_number(value)}' for name, value in figures.items())
    return '  '.join(named) + f'  {unit}'


def _pauses(pauses: Mapping[str, float]) -> str:
    if not pauses['count']:
        return '0'
    return f'{pauses["count"]} of {pauses["total_s"]:.2f} s, longest {pauses["longest_s"]:.2f} s'


def _counts(counts: Mapping[str, int]) -> str:
    return ', '.join(f'{count} {name.replace("_", " ")}' for name, count in counts.items())


def _number(value: float | None) -> str:
    return 'none' if value is None else f'{value:.2f}'
