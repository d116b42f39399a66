"""A validation as one HTML page: the table, and pictures of what it sums up."""

from pathlib import Path

from push_report.page import write_page

from push_sim.validation.comparison import Validation
from push_sim.validation.push_figures import long_figure, short_figure
from push_sim.validation.run_figure import run_figure


def write_validation_page(path: Path, found: Validation, profile: str, table: str) -> None:
    """Writes the page; whole or not at all.

    Args:
        path: of the HTML file.
        found: what was compared.
        profile: name of the plant's.
        table: the figures as text.

    Raises:
        InputError: the file cannot be written.
    """
    figures = [
        *([short_figure(found.short)] if found.short else []),
        *(long_figure(each) for each in found.long),
        *(run_figure(each) for each in found.runs),
    ]
    title = f'The plant against measurements, profile {profile}'
    write_page(path, title, table.splitlines(), figures)
