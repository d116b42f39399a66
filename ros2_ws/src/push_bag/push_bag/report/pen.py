"""Draws the lines of one run into the figure over time: alone, or among other runs."""

from dataclasses import dataclass

import plotly.graph_objects as go
from push_report.figure_style import INK, RED, thinned

from push_bag.report.view import View
from push_bag.run import Floats


@dataclass(frozen=True)
class Pen:
    """Where and for whom is drawn.

    Attributes:
        figure: with one row for each quantity.
        view: the run.
        alone: whether it has the figure to itself: each line then has a colour and a name of
            its own; otherwise all lines of a run share its colour and its name, and what would
            crowd the rows is left out.
    """

    figure: go.Figure
    view: View
    alone: bool

    def line(self, row: int, name: str, time: Floats, values: Floats, colour: str) -> None:
        """The main line of a row, values (n,) over times (n,) [s]."""
        if self.alone:
            self._add(row, name, time, values, {'color': colour, 'width': 1.5})
        else:
            style = {'color': self.view.colour, 'width': 1.5}
            self._add(row, self.view.name, time, values, style)

    def detail(self, row: int, name: str, time: Floats, values: Floats, colour: str) -> None:
        """A further line, drawn only for a run that is alone."""
        if self.alone:
            self._add(row, name, time, values, {'color': colour, 'width': 1.5})

    def wanted(self, row: int, time: Floats, values: Floats) -> None:
        """What the reference says, drawn only for a run that is alone."""
        if self.alone:
            style = {'color': INK, 'width': 1.5, 'dash': 'dot'}
            self._add(row, 'nominal', time, values, style)

    def marks(self, row: int, name: str, time: Floats, values: Floats) -> None:
        """Red points, drawn only for a run that is alone."""
        if self.alone and time.size:
            x, y = thinned(time, values)
            style = {'color': RED, 'size': 5}
            points = go.Scatter(x=x, y=y, mode='markers', name=name, marker=style)
            self.figure.add_trace(points, row=row, col=1)

    def _add(
        self, row: int, name: str, time: Floats, values: Floats, style: dict[str, object]
    ) -> None:
        x, y = thinned(time, values)
        trace = go.Scatter(x=x, y=y, mode='lines', name=name, line=style, hovertemplate='%{y:.2f}')
        self.figure.add_trace(trace, row=row, col=1)
