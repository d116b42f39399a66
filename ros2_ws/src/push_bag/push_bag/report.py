"""The report of a run: one HTML file that needs nothing else, also offline."""

from collections.abc import Iterable, Mapping
from html import escape
from pathlib import Path
from typing import Any

import plotly.graph_objects as go
from plotly.offline import get_plotlyjs
from push_core.atomic_file import write_atomically
from push_core.errors import InputError

from push_bag.contact import contact
from push_bag.lap_figure import lap_figure
from push_bag.run_reader import read_run
from push_bag.score import score_json, score_series
from push_bag.score_table import messages_line, score_rows
from push_bag.series import RunSeries
from push_bag.time_figure import time_figure
from push_bag.timing import timing
from push_bag.timing_figure import timing_figure
from push_bag.tracking import track

SCORE_FILE = 'score.json'
REPORT_FILE = 'report.html'

STYLE = """
body { margin: 0 auto; max-width: 1180px; padding: 24px; color: #1f2933; background: #f4f6f8;
       font: 15px/1.45 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { margin: 0 0 4px; font-size: 26px; } h2 { margin: 0 0 8px; font-size: 18px; }
section { margin: 18px 0; padding: 18px 20px; background: white; border-radius: 8px;
          box-shadow: 0 1px 3px rgb(0 0 0 / 12%); }
.verdict { padding: 2px 10px; border-radius: 12px; color: white; font-size: 15px;
           vertical-align: middle; }
.yes { background: #00795c; } .no { background: #b34700; }
.cards { display: flex; flex-wrap: wrap; gap: 12px; margin-top: 16px; }
.card { flex: 1 1 130px; padding: 12px 16px; background: white; border-radius: 8px;
        box-shadow: 0 1px 3px rgb(0 0 0 / 12%); }
.card b { display: block; font-size: 23px; } .card span { color: #5d6873; font-size: 13px; }
table { border-collapse: collapse; width: 100%; }
th, td { padding: 5px 12px 5px 0; border-bottom: 1px solid #e4e8ec; text-align: left;
         vertical-align: top; overflow-wrap: anywhere; }
td { white-space: pre-wrap; }
th { width: 200px; font-weight: 600; white-space: nowrap; }
"""


def write_results(folder: Path) -> dict[str, Any]:
    """Puts `score.json` and `report.html` into a run's folder and returns the score.

    Raises:
        InputError: there is no readable bag or no reference in it, or a file cannot be written.
    """
    run = read_run(folder)
    score = score_series(run)
    write_atomically(folder / SCORE_FILE, score_json(score).encode())
    write_atomically(folder / REPORT_FILE, report_html(run, score).encode())
    return score


def report_html(run: RunSeries, score: Mapping[str, Any]) -> str:
    """The report as one page.

    Args:
        run: what was recorded.
        score: of the same run.

    Raises:
        InputError: the run holds no reference.
    """
    if run.reference is None:
        raise InputError('the bag holds no nominal trajectory, so there is nothing to report')
    tracking, touching = track(run, run.reference), contact(run, run.reference)
    lap = lap_figure(run.reference, tracking, run.disturbances)
    over_time = time_figure(run, run.reference, tracking, touching)
    sections = [
        _section('The lap', _figure(lap, 'lap')),
        _section('Over time', _figure(over_time, 'time')),
        _section('Timing', _figure(timing_figure(timing(run)), 'timing')),
        _section('Score', _table([*score_rows(score), ('messages', messages_line(score))])),
        _section('Messages', _table(_message_rows(score))),
        _section('Run facts', _table(sorted(run.facts.items()))),
    ]
    return _page(_title(score), _head(score), sections)


def _page(title: str, head: str, sections: list[str]) -> str:
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<title>{escape(title)}</title><style>{STYLE}</style>'
        f'<script>{get_plotlyjs()}</script></head>\n<body>{head}{"".join(sections)}</body></html>\n'
    )


def _title(score: Mapping[str, Any]) -> str:
    return f'{score["track"]} at {score["speed_m_s"] * 1e3:.0f} mm/s, {score["controller"]}'


def _head(score: Mapping[str, Any]) -> str:
    good = score['completed']
    verdict = f'<span class="verdict {"yes" if good else "no"}">{_verdict(score)}</span>'
    cards = ''.join(_card(name, value) for name, value in _headlines(score))
    return f'<h1>{escape(_title(score))} {verdict}</h1><div class="cards">{cards}</div>'


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


def _card(name: str, value: str) -> str:
    return f'<div class="card"><b>{escape(value)}</b><span>{escape(name)}</span></div>'


def _section(title: str, content: str) -> str:
    return f'<section><h2>{escape(title)}</h2>{content}</section>\n'


def _figure(figure: go.Figure, name: str) -> str:
    config = {'displaylogo': False, 'responsive': True}
    return str(figure.to_html(config=config, include_plotlyjs=False, full_html=False, div_id=name))


def _message_rows(score: Mapping[str, Any]) -> list[tuple[str, str]]:
    return [
        (topic, f'{counts["received"]} received, {_lost(counts["lost"])} lost')
        for topic, counts in score['messages'].items()
    ]


def _lost(count: int | None) -> str:
    return 'unknown' if count is None else str(count)


def _table(rows: Iterable[tuple[str, str]]) -> str:
    lines = (f'<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>' for name, value in rows)
    return f'<table>{"".join(lines)}</table>'
