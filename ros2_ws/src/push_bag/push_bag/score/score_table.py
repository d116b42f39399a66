"""The score of a run as text."""

from collections.abc import Mapping
from typing import Any

from push_core.common import plain_table

Row = tuple[str, str]


def score_table(score: Mapping[str, Any]) -> str:
    """The score as a table of names and values, then a line about lost messages."""
    lines = plain_table(score_rows(score), left=2)
    return '\n'.join([*lines, '', messages_line(score)]) + '\n'


def score_rows(score: Mapping[str, Any]) -> list[Row]:
    """Name and value of each line, with units."""
    return [
        ('completed', _verdict(score)),
        ('run', _run(score)),
        ('model', _model(score['model'])),
        ('duration', _number(score['duration_s'], 's')),
        ('tracking error', _figures(score['tracking_error_mm'], 'mm')),
        ('error of the true pose', _truth(score['truth'])),
        ('cross-track error', _figures(score['cross_track_mm'], 'mm')),
        ('heading error', _figures(score['heading_error_deg'], 'deg')),
        ('solve', _figures(score['solve_ms'], 'ms')),
        ('tick', _figures(score['tick_ms'], 'ms')),
        ('pose to command', _figures(score['pose_to_command_ms'], 'ms')),
        ('deadline misses', str(score['deadline_misses'])),
        ('holds', str(score['holds'])),
        ('contact losses', str(score['contact_losses'])),
        ('limited ticks', _counts(score['limited'])),
        ('bag', _bag(score)),
    ]


def messages_lost(score: Mapping[str, Any]) -> int:
    """Number of lost messages on all topics."""
    return sum(counts['lost'] or 0 for counts in score['messages'].values())


def messages_line(score: Mapping[str, Any]) -> str:
    """A line such as `0 of 14130 messages lost`, with the topics that lost messages."""
    topics = score['messages']
    lost = {name: counts['lost'] for name, counts in topics.items() if counts['lost']}
    sent = sum(counts['received'] for counts in topics.values()) + sum(lost.values())
    named = ''.join(f'; {name} {count}' for name, count in lost.items())
    return f'{sum(lost.values())} of {sent} messages lost{named}'


def _bag(score: Mapping[str, Any]) -> str:
    if score['recovered_from']:
        return f'recovered from {score["recovered_from"]}; messages may be missing'
    return 'finished' if score['bag_finished'] else 'unfinished: the recording was cut short'


def _verdict(score: Mapping[str, Any]) -> str:
    if score['completed']:
        return 'yes'
    return f'no, stopped: {score["stop_reason"]}' if score['stop_reason'] else 'no'


def _run(score: Mapping[str, Any]) -> str:
    laps = f'{score["laps"]} lap' + ('s' if score['laps'] != 1 else '')
    words = [score['track'], f'{score["speed_m_s"] * 1e3:.0f} mm/s', laps, score['controller']]
    words += [score['profile'], score['mode']]
    seed = [] if score['seed'] is None else [f'seed {score["seed"]}']
    return ', '.join([word for word in words if word] + seed)


def _model(model: Mapping[str, Any] | None) -> str:
    if model is None:
        return 'none recorded'
    return f'{model["kind"]}, {model["points"]} pushes, {model["hash"][:12]}'


def _figures(figures: Mapping[str, float | None], unit: str) -> str:
    named = (f'{name.replace("_", " ")} {_number(value)}' for name, value in figures.items())
    return '  '.join(named) + f'  {unit}'


def _truth(figures: Mapping[str, float | None] | None) -> str:
    return 'none: the bag holds no ground truth' if figures is None else _figures(figures, 'mm')


def _counts(counts: Mapping[str, int]) -> str:
    return ', '.join(f'{count} {name.replace("_", " ")}' for name, count in counts.items())


def _number(value: float | None, unit: str = '') -> str:
    return 'none' if value is None else f'{value:.2f} {unit}'.strip()
