"""Figures that are stored in the page as data and drawn by `figures.js` when they come into view.

Drawing takes a browser longer than reading: a report opens as soon as its first figure is drawn.
"""

from importlib.resources import files

import plotly.graph_objects as go

LIBRARY = 'plotly/plotly-basic.min.js'


def deferred(figure: go.Figure, name: str) -> str:
    """HTML of a figure of lines, points and bars; `name` becomes the id of its element."""
    # plotly's JSON has no '<', which could end the script element
    return (
        f'<div id="{name}" class="figure" style="height: {figure.layout.height}px"></div>'
        f'<script type="application/json" id="{name}-figure">{figure.to_json()}</script>'
    )


def is_figure(html: str) -> bool:
    """Whether HTML holds a figure that is to be drawn."""
    return 'class="figure"' in html


def drawing_library() -> str:
    """The part of plotly.js that such figures need."""
    return files('push_report').joinpath(LIBRARY).read_text(encoding='utf-8')


def drawing_script() -> str:
    """JavaScript that draws each figure of the page when it comes near the window."""
    return files('push_report').joinpath('figures.js').read_text(encoding='utf-8')
