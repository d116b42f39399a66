"""HTML pages of text and plotly figures, self-contained, to be read offline.

Importing plotly takes a second: import this module only when a page is written.
"""

from collections.abc import Sequence
from html import escape
from importlib.resources import files
from pathlib import Path

import plotly.graph_objects as go
from push_core.common import write_atomically

from push_report.deferred_figure import deferred, drawing_library, drawing_script, is_figure
from push_report.figure_style import HEIGHT, styled


def page(title: str, sections: Sequence[str], head: str = '', script: str = '') -> str:
    """HTML of a page; with the drawing library if a section holds a figure.

    Args:
        title: of the page.
        sections: HTML of each, see `section`.
        head: HTML above the sections; default: the title.
        script: JavaScript that runs after the page has loaded.
    """
    style = files('push_report').joinpath('page.css').read_text(encoding='utf-8')
    above = head or f'<h1>{escape(title)}</h1>'
    draws = any(map(is_figure, sections))
    library = f'<script>{drawing_library()}</script>' if draws else ''
    drawing = f'{drawing_script()}\n' if draws else ''
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        # an icon of nothing, so that a browser asks for none
        '<link rel="icon" href="data:,">'
        f'<title>{escape(title)}</title><style>{style}</style>{library}</head>\n'
        f'<body>{above}{"".join(sections)}<script>{drawing}{script}</script></body></html>\n'
    )


def section(heading: str, content: str, text: str = '') -> str:
    """HTML of a section: a heading, unless it is empty, a text that explains, HTML content."""
    above = f'<h2>{escape(heading)}</h2>' if heading else ''
    explanation = f'<p class="hint">{escape(text)}</p>' if text else ''
    return f'<section>{above}{explanation}{content}</section>\n'


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """HTML of a table of text cells, which scrolls sideways where it is wider than the page."""
    head = ''.join(f'<th>{escape(each)}</th>' for each in heads)
    body = ''.join(
        f'<tr>{"".join(f"<td>{escape(cell)}</td>" for cell in row)}</tr>' for row in rows
    )
    return f'<div class="wide"><table class="columns"><tr>{head}</tr>{body}</table></div>'


def panels(figures: Sequence[go.Figure], name: str) -> str:
    """HTML of figures side by side, one below the other where the window is narrow."""
    parts = (deferred(each, f'{name}-{number}') for number, each in enumerate(figures, start=1))
    return f'<div class="panels">{"".join(parts)}</div>'


def write_page(
    path: Path,
    title: str,
    lines: Sequence[str],
    parts: Sequence[tuple[str, Sequence[go.Figure]]],
    text: str = '',
) -> None:
    """Writes a page atomically: its text, then a section of figures for each part.

    Args:
        path: of the HTML file.
        title: of the page.
        lines: preformatted text above the figures.
        parts: heading and figures of each section.
        text: explains the page, below the title.

    Raises:
        InputError: the file cannot be written.
    """
    words = escape('\n'.join(lines))
    sections = [section('', f'<pre>{words}</pre>', text)]
    for number, (heading, figures) in enumerate(parts, start=1):
        for figure in figures:
            styled(figure, figure.layout.height or HEIGHT)
        sections.append(section(heading, panels(figures, f'figure-{number}')))
    write_atomically(path, page(title, sections).encode())
