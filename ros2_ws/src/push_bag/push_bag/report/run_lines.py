"""Adds the lines of one run to the figure over time."""

from dataclasses import dataclass

import plotly.graph_objects as go
from push_report.figure_style import INK, RED, thinned

from push_bag.report.reported_run import ReportedRun
from push_bag.run import Floats


@dataclass(frozen=True)
class RunLines:
    """The lines of one run in a figure.

    Attributes:
        figure: one row for each quantity.
        run: the run.
        alone: whether the figure shows this run only. If so, each line has its own colour and
            name; if not, all lines of a run share the run's colour and name, and details,
            reference and marks are left out.
    """

    figure: go.Figure
    run: ReportedRun
    alone: bool

    def line(self, row: int, name: str, time: Floats, values: Floats, colour: str) -> None:
        """Adds the main line of a row: values (n,) over times (n,) [s]."""
        if self.alone:
            self._add(row, name, time, values, {'color': colour, 'width': 1.5})
        else:
            style = {'color': self.run.colour, 'width': 1.5}
            self._add(row, self.run.name, time, values, style)

    def detail(self, row: int, name: str, time: Floats, values: Floats, colour: str) -> None:
        """Adds a further line if the run is alone."""
        if self.alone:
            self._add(row, name, time, values, {'color': colour, 'width': 1.5})

    def nominal(self, row: int, time: Floats, values: Floats) -> None:
        """Adds the reference's values if the run is alone."""
        if self.alone:
            style = {'color': INK, 'width': 1.5, 'dash': 'dot'}
            self._add(row, 'nominal', time, values, style)

    def marks(self, row: int, name: str, time: Floats, values: Floats) -> None:
        """Adds red points if the run is alone."""
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
