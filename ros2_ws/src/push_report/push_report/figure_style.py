"""Style of the figures: colours, fonts, number of points."""

from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray

# palette of Okabe and Ito, for colour-blind readers
BLUE, ORANGE, GREEN, RED = '#0072b2', '#e69f00', '#009e73', '#d55e00'
PURPLE, SKY = '#cc79a7', '#56b4e9'
RUN_COLOURS = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY)  # of runs that share a figure
INK, GREY, PALE, FAINT = '#1f2933', '#8a94a0', '#c3cad1', '#e4e8ec'
LOW_TO_HIGH = ((0.0, '#2b6cb0'), (0.5, '#b569a8'), (1.0, '#d7301f'))
DIVERGING = ((0.0, '#2b6cb0'), (0.5, '#e8e8e8'), (1.0, '#d7301f'))
HEIGHT = 420
MOST_MARKERS = 1500  # a marker takes as long to draw as ten points of a line
ROBUST_END = 'twice the 90 % quantile'  # where a robust scale ends, for a text
MOST_POINTS = 5000  # of one series; keeps a run of any length below 6 MB

FONT = {'family': 'system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif', 'size': 13}
AXIS = {
    'gridcolor': FAINT,
    'linecolor': GREY,
    'zeroline': False,
    'showline': True,
    'ticks': 'outside',
    'tickcolor': GREY,
    'title_standoff': 8,
}


def styled(figure: go.Figure, height: int, **layout: Any) -> go.Figure:
    """The figure in the report's style, `height` pixels high."""
    figure.update_layout(
        template='none',
        height=height,
        font=FONT | {'color': INK},
        margin={'l': 70, 'r': 20, 't': 64, 'b': 50},
        paper_bgcolor='white',
        plot_bgcolor='white',
        legend={'orientation': 'h', 'y': 1.0, 'yanchor': 'bottom', 'x': 0.0},
    )
    figure.update_xaxes(**AXIS)
    figure.update_yaxes(**AXIS)
    return figure.update_layout(**layout)


def robust_limit(values: NDArray[Any], least: float) -> float:
    """The end of a scale for values (n,) >= 0 on which a few large ones do not flatten the rest.

    That is the largest value, at most twice the 90 % quantile, and at least `least`.
    """
    known = values[np.isfinite(values)]
    if not known.size:
        return least
    return max(least, min(float(known.max()), 2.0 * float(np.quantile(known, 0.9))))


def thinned(*series: NDArray[Any], most: int = MOST_POINTS) -> tuple[NDArray[np.float32], ...]:
    """Series (n,) of one length, every k-th point where n is above a limit, as float32."""
    step = max(1, -(-series[0].shape[0] // most))
    return tuple(np.asarray(values[::step], np.float32) for values in series)
