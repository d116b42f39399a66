"""The page of a running cell, of the report's parts: figures that `live.js` fills."""

from importlib.resources import files
from typing import Any

import plotly.graph_objects as go
from push_node import interface
from push_report.deferred_figure import deferred
from push_report.figure_style import BLUE, GREEN, GREY, INK, ORANGE, RED, styled
from push_report.page import page, section

ACTIONS = {
    'reset_to_plan': ('Put at the start', interface.RESET_TO_PLAN),
    'start': ('Start', interface.START),
    'stop': ('Stop', interface.STOP),
    'resume': ('Release the stop', interface.RESUME),
}
"""Name, label and service of each button."""
_CARDS = {
    'error': 'error, mm',
    'p_y': 'contact offset p_y, mm',
    'speed': 'speed of the tip, mm/s',
    'reference_time': 'time of the reference, s',
    'solve_ms': 'QP, ms',
}


def live_page(control: bool) -> str:
    """HTML of the page.

    Args:
        control: whether it has buttons.
    """
    script = files('push_bag.report').joinpath('live.js').read_text(encoding='utf-8')
    sections = [
        section('', f'<div id="buttons" class="controls">{_buttons()}</div>') if control else '',
        section(
            'From above',
            deferred(_map(), 'map'),
            'The measured object and tip, the reference and the plan of the controller.',
        ),
        section('Error and contact', deferred(_lines(_ERRORS, '[mm]'), 'errors')),
        section(
            'Velocity of the tip',
            deferred(_lines(_VELOCITIES, '[mm/s]'), 'velocities'),
            'In the world frame; the measured one follows the command after the lag of the robot.',
        ),
        section(
            'What is estimated',
            deferred(_lines(_ESTIMATES, ''), 'estimates'),
            'Error of the model as the controller estimates it: displacement of the object per '
            'travel of the tip [mm/m] along the normal and the face, rotation per travel [deg/m].',
        ),
    ]
    return page('Pushing cell, live', sections, head=_head(), script=script)


def _head() -> str:
    cards = ''.join(
        f'<div class="card"><b id="{name}">–</b><span>{text}</span></div>'
        for name, text in _CARDS.items()
    )
    return (
        '<h1>Pushing cell <span id="mode" class="verdict no">no messages yet</span></h1>'
        '<div id="title" class="hint"></div><div id="reason" class="hint"></div>'
        f'<div class="cards">{cards}</div>'
    )


def _buttons() -> str:
    buttons = (f'<button id="{name}">{label}</button>' for name, (label, _) in ACTIONS.items())
    return f'{"".join(buttons)}<span id="answer" class="hint"></span>'


def _map() -> go.Figure:
    figure = go.Figure()
    parts: tuple[tuple[str, dict[str, Any]], ...] = (
        ('reference', {'line': {'color': INK, 'width': 1.2, 'dash': 'dot'}}),
        ('trail', {'line': {'color': GREY, 'width': 1.5}}),
        ('object', {'line': {'color': BLUE, 'width': 2}, 'fill': 'toself'}),
        ('horizon', {'line': {'color': ORANGE, 'width': 4}}),
        ('tip', {'line': {'color': INK, 'width': 1.5}, 'fill': 'toself', 'fillcolor': INK}),
    )
    for name, style in parts:
        figure.add_trace(go.Scatter(x=[], y=[], mode='lines', name=name, **style))
    styled(figure, 560, hovermode=False)
    figure.update_xaxes(title='x [mm]', range=[-300, 300])
    return figure.update_yaxes(title='y [mm]', range=[-300, 300], scaleanchor='x')


_ERRORS = (('error', RED), ('p_y', BLUE), ('gap', GREY))
_VELOCITIES = (
    *(('command x', BLUE), ('tip x', GREY)),
    *(('command y', RED), ('tip y', ORANGE)),
)
_ESTIMATES = (('normal', BLUE), ('along the face', RED), ('rotation', GREEN))


def _lines(traces: tuple[tuple[str, str], ...], unit: str) -> go.Figure:
    figure = go.Figure()
    for name, colour in traces:
        line = {'color': colour, 'width': 1.6}
        figure.add_trace(go.Scatter(x=[], y=[], mode='lines', name=name, line=line))
    styled(figure, 280, xaxis_title='time [s], now = 0', hovermode=False)
    figure.update_xaxes(range=[-20.0, 0.0])
    return figure.update_yaxes(title=unit)
