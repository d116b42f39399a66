"""The report of one or several runs: one HTML file that works offline."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any

from push_core.common import json_text, write_atomically
from push_report.deferred_figure import deferred
from push_report.page import page, panels, section

from push_bag.report.animation import animation_data, animation_figure
from push_bag.report.lap_figure import TEXT as LAP_TEXT
from push_bag.report.lap_figure import lap_figure
from push_bag.report.learning_figure import TEXT as LEARNING_TEXT
from push_bag.report.learning_figure import lap_figures, shift_figure
from push_bag.report.reported_run import ReportedRun, Scored, reported_runs, title
from push_bag.report.time_figure import TEXT as TIME_TEXT
from push_bag.report.time_figure import time_figure
from push_bag.report.timing_figure import timing_figures
from push_bag.run import read_starts
from push_bag.score import bag_score, messages_line, score_rows, score_series

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
    """Writes `score.json` and `report.html` to a run's folder and returns the score.

    Args:
        folder: of the run.
        reason: why the cell ended the run early, empty if it did not; used where the bag does
            not state a reason, as after the death of the recorder.

    Raises:
        InputError: there is no readable bag or no reference in it, or a file cannot be written.
    """
    scored = [(run, score_series(run)) for run in read_starts(folder)]
    last = scored[-1][1]
    last['stop_reason'] = last['stop_reason'] or reason or None
    score = bag_score([each for _, each in scored])
    write_atomically(folder / SCORE_FILE, json_text(score).encode())
    write_atomically(folder / REPORT_FILE, report_html(scored).encode())
    return score


def report_html(scored: Sequence[Scored]) -> str:
    """The report as one HTML page.

    Args:
        scored: runs, each with its score; several share each figure.

    Raises:
        InputError: a run holds no reference.
    """
    runs = reported_runs(scored)
    sections = [
        section('The lap', deferred(lap_figure(runs), 'lap'), LAP_TEXT if len(runs) == 1 else ''),
        *_learning(runs),
        section('In motion', CONTROLS + deferred(animation_figure(runs), 'animation')),
        section('Over time', deferred(time_figure(runs), 'time'), TIME_TEXT),
        section('Timing', panels(timing_figures(runs), 'timing')),
        section('Score', _table(_names(runs), _score_rows(runs))),
        section('Messages', _table(_names(runs), _message_rows(runs))),
        section('Run facts', _table(_names(runs), _fact_rows(runs))),
    ]
    head = _head_of_one(runs[0]) if len(runs) == 1 else _head_of_several(runs)
    page_title = title(runs[0].score) if len(runs) == 1 else f'{len(runs)} runs'
    return page(page_title, sections, head, _script(runs))


def _learning(runs: Sequence[ReportedRun]) -> list[str]:
    """What changed from lap to lap; nothing where no run has several laps."""
    figures = lap_figures(runs)
    if not figures:
        return []
    shift = shift_figure(runs[0]) if len(runs) == 1 else None
    shown = panels(figures, 'laps') + (deferred(shift, 'shift') if shift else '')
    return [section('Lap after lap', shown, LEARNING_TEXT)]


def _script(runs: Sequence[ReportedRun]) -> str:
    script = files('push_bag.report').joinpath('report.js').read_text(encoding='utf-8')
    return f'const ANIMATION = {animation_data(runs)};\n{script}'


def _head_of_one(run: ReportedRun) -> str:
    good = run.score['completed']
    verdict = f'<span class="verdict {"yes" if good else "no"}">{_verdict(run.score)}</span>'
    cards = ''.join(_card(name, value) for name, value in _headlines(run.score))
    return f'<h1>{escape(title(run.score))} {verdict}</h1><div class="cards">{cards}</div>'


def _head_of_several(runs: Sequence[ReportedRun]) -> str:
    cards = ''.join(_card(run.name, _in_short(run), run.colour) for run in runs)
    return f'<h1>{len(runs)} runs</h1><div class="cards">{cards}</div>'


def _in_short(run: ReportedRun) -> str:
    mean = _measure(run.score['tracking_error_mm']['mean'], 'mm')
    return mean if run.score['completed'] else f'{mean}, {_verdict(run.score)}'


def _verdict(score: Mapping[str, Any]) -> str:
    if score['completed']:
        return 'completed'
    reason = score['reasons'].get('completed')
    if score['completed'] is None:
        return escape(f'not known whether completed: {reason}')
    if reason:
        return escape(f'not completed: {reason}')
    return escape(f'stopped: {score["stop_reason"]}' if score['stop_reason'] else 'not completed')


def _headlines(score: Mapping[str, Any]) -> list[tuple[str, str]]:
    errors, truth = score['tracking_error_mm'], score['truth']
    return [
        ('mean tracking error', _measure(errors['mean'], 'mm')),
        *([('mean error of the true pose', _measure(truth['mean'], 'mm'))] if truth else []),
        ('largest tracking error', _measure(errors['max'], 'mm')),
        ('p99 of solving', _measure(score['solve_ms']['p99'], 'ms')),
        ('p99 of pose to command', _measure(score['pose_to_command_ms']['p99'], 'ms')),
        ('deadline misses', _count(score['deadline_misses'])),
        ('contact losses', _count(score['contact_losses'])),
    ]


def _measure(value: float | None, unit: str) -> str:
    return '–' if value is None else f'{value:.2f} {unit}'


def _count(value: int | None) -> str:
    return '–' if value is None else str(value)


def _card(name: str, value: str, colour: str = '') -> str:
    key = f'<i class="key" style="background: {colour}"></i>' if colour else ''
    return f'<div class="card"><b>{escape(value)}</b><span>{key}{escape(name)}</span></div>'


def _names(runs: Sequence[ReportedRun]) -> list[str]:
    """Heads of the tables' columns; none for one run."""
    return [run.name for run in runs] if len(runs) > 1 else []


def _score_rows(runs: Sequence[ReportedRun]) -> list[list[str]]:
    tables = [
        dict([*score_rows(run.score), ('messages', messages_line(run.score))]) for run in runs
    ]
    names = dict.fromkeys(name for table in tables for name in table)
    return [[name, *(table.get(name, '–') for table in tables)] for name in names]


def _message_rows(runs: Sequence[ReportedRun]) -> list[list[str]]:
    topics = sorted({topic for run in runs for topic in run.score['messages']})
    return [[topic, *(_traffic(run.score, topic) for run in runs)] for topic in topics]


def _traffic(score: Mapping[str, Any], topic: str) -> str:
    counts = score['messages'].get(topic)
    if counts is None:
        return '–'
    lost = 'unknown' if counts['lost'] is None else counts['lost']
    return f'{counts["received"]} received, {lost} lost'


def _fact_rows(runs: Sequence[ReportedRun]) -> list[list[str]]:
    names = sorted({name for run in runs for name in run.series.facts})
    return [[name, *(run.series.facts.get(name, '–') for run in runs)] for name in names]


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    head = _row('th', ['', *heads]) if heads else ''
    return f'<table>{head}{"".join(_row("td", row) for row in rows)}</table>'


def _row(cell: str, values: Sequence[str]) -> str:
    first, *others = (escape(value) for value in values)
    cells = ''.join(f'<{cell}>{value}</{cell}>' for value in others)
    return f'<tr><th>{first}</th>{cells}</tr>'
