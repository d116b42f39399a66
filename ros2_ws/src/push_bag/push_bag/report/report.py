"""The report of one run or of several: one HTML file that needs nothing else, also offline."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any

from push_core.common import json_text, write_atomically
from push_report.deferred_figure import deferred, drawing_library, drawing_script
from push_report.page import page, section

from push_bag.report.animation import animation_data, animation_figure
from push_bag.report.lap_figure import lap_figure
from push_bag.report.time_figure import time_figure
from push_bag.report.timing_figure import timing_figure
from push_bag.report.view import Scored, View, title, views
from push_bag.run import read_run
from push_bag.score import messages_line, score_rows, score_series

SCORE_FILE = 'score.json'
REPORT_FILE = 'report.html'
CONTROLS = """
<div class="controls"><button id="play">Play</button>
<select id="pace" title="pace"><option value="0.25">1/4 x</option>
<option value="1" selected>1 x</option><option value="4">4 x</option></select>
<input id="cursor" type="range" min="0" step="0.01" value="0"><output id="cursor-time"></output>
</div><p class="hint">A click on the lap or on a line over time moves the cursor there.</p>
"""


def write_results(folder: Path, reason: str = '') -> dict[str, Any]:
    """Puts `score.json` and `report.html` into a run's folder and returns the score.

    Args:
        folder: of the run.
        reason: why the cell ended it, empty if it came to its end. A recorder that died could
            not write it down.

    Raises:
        InputError: there is no readable bag or no reference in it, or a file cannot be written.
    """
    run = read_run(folder)
    score = score_series(run)
    score['stop_reason'] = score['stop_reason'] or reason or None
    write_atomically(folder / SCORE_FILE, json_text(score).encode())
    write_atomically(folder / REPORT_FILE, report_html([(run, score)]).encode())
    return score


def report_html(scored: Sequence[Scored]) -> str:
    """The report as one page.

    Args:
        scored: runs, each with its score; several are drawn over each other.

    Raises:
        InputError: a run holds no reference.
    """
    shown = views(scored)
    sections = [
        section('The lap', deferred(lap_figure(shown), 'lap')),
        section('In motion', CONTROLS + deferred(animation_figure(shown), 'animation')),
        section('Over time', deferred(time_figure(shown), 'time')),
        section('Timing', deferred(timing_figure(shown), 'timing')),
        section('Score', _table(_names(shown), _score_rows(shown))),
        section('Messages', _table(_names(shown), _message_rows(shown))),
        section('Run facts', _table(_names(shown), _fact_rows(shown))),
    ]
    head = _head_of_one(shown[0]) if len(shown) == 1 else _head_of_several(shown)
    page_title = title(shown[0].score) if len(shown) == 1 else f'{len(shown)} runs'
    return page(page_title, sections, head, _script(shown), drawing_library())


def _script(shown: Sequence[View]) -> str:
    moving = files('push_bag.report').joinpath('report.js').read_text(encoding='utf-8')
    return f'const ANIMATION = {animation_data(shown)};\n{drawing_script()}\n{moving}'


def _head_of_one(view: View) -> str:
    good = view.score['completed']
    verdict = f'<span class="verdict {"yes" if good else "no"}">{_verdict(view.score)}</span>'
    cards = ''.join(_card(name, value) for name, value in _headlines(view.score))
    return f'<h1>{escape(title(view.score))} {verdict}</h1><div class="cards">{cards}</div>'


def _head_of_several(shown: Sequence[View]) -> str:
    cards = ''.join(_card(view.name, _in_short(view), view.colour) for view in shown)
    return f'<h1>{len(shown)} runs</h1><div class="cards">{cards}</div>'


def _in_short(view: View) -> str:
    mean = _measure(view.score['tracking_error_mm']['mean'], 'mm')
    return mean if view.score['completed'] else f'{mean}, {_verdict(view.score)}'


def _verdict(score: Mapping[str, Any]) -> str:
    if score['completed']:
        return 'completed'
    return escape(f'stopped: {score["stop_reason"]}' if score['stop_reason'] else 'not completed')


def _headlines(score: Mapping[str, Any]) -> list[tuple[str, str]]:
    errors = score['tracking_error_mm']
    return [
        ('mean tracking error', _measure(errors['mean'], 'mm')),
        ('largest tracking error', _measure(errors['max'], 'mm')),
        ('p99 of solving', _measure(score['solve_ms']['p99'], 'ms')),
        ('p99 of pose to command', _measure(score['pose_to_command_ms']['p99'], 'ms')),
        ('deadline misses', str(score['deadline_misses'])),
        ('contact losses', str(score['contact_losses'])),
    ]


def _measure(value: float | None, unit: str) -> str:
    return '–' if value is None else f'{value:.2f} {unit}'


def _card(name: str, value: str, colour: str = '') -> str:
    key = f'<i class="key" style="background: {colour}"></i>' if colour else ''
    return f'<div class="card"><b>{escape(value)}</b><span>{key}{escape(name)}</span></div>'


def _names(shown: Sequence[View]) -> list[str]:
    """Heads of the tables' columns; a run that is alone needs none."""
    return [view.name for view in shown] if len(shown) > 1 else []


def _score_rows(shown: Sequence[View]) -> list[list[str]]:
    tables = [[*score_rows(view.score), ('messages', messages_line(view.score))] for view in shown]
    return [[rows[0][0], *(value for _, value in rows)] for rows in zip(*tables, strict=True)]


def _message_rows(shown: Sequence[View]) -> list[list[str]]:
    topics = sorted({topic for view in shown for topic in view.score['messages']})
    return [[topic, *(_traffic(view.score, topic) for view in shown)] for topic in topics]


def _traffic(score: Mapping[str, Any], topic: str) -> str:
    counts = score['messages'].get(topic)
    if counts is None:
        return '–'
    lost = 'unknown' if counts['lost'] is None else counts['lost']
    return f'{counts["received"]} received, {lost} lost'


def _fact_rows(shown: Sequence[View]) -> list[list[str]]:
    names = sorted({name for view in shown for name in view.run.facts})
    return [[name, *(view.run.facts.get(name, '–') for view in shown)] for name in names]


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    head = _row('th', ['', *heads]) if heads else ''
    return f'<table>{head}{"".join(_row("td", row) for row in rows)}</table>'


def _row(cell: str, values: Sequence[str]) -> str:
    first, *others = (escape(value) for value in values)
    cells = ''.join(f'<{cell}>{value}</{cell}>' for value in others)
    return f'<tr><th>{first}</th>{cells}</tr>'
