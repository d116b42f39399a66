"""HTML pages of text and plotly figures, self-contained, to be read offline.

Importing plotly takes a second: import this module only when a page is written.
"""

from collections.abc import Sequence
from html import escape
from importlib.resources import files
from pathlib import Path

import plotly.graph_objects as go
from plotly.offline import get_plotlyjs
from push_core.common import write_atomically

COLOURS = ('#3366aa', '#bb5533', '#448844')
DIVERGING = 'RdBu'
HEIGHT = 420


def page(
    title: str, sections: Sequence[str], head: str = '', script: str = '', library: str = ''
) -> str:
    """HTML of a page.

    Args:
        title: of the page.
        sections: HTML of each, see `section`; figures without the drawing library.
        head: HTML above the sections; default: the title.
        script: JavaScript that runs after the page has loaded.
        library: JavaScript that draws the figures; default: all of plotly.js.
    """
    style = files('push_report').joinpath('page.css').read_text(encoding='utf-8')
    above = head or f'<h1>{escape(title)}</h1>'
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<title>{escape(title)}</title><style>{style}</style>'
        f'<script>{library or get_plotlyjs()}</script></head>\n<body>{above}{"".join(sections)}'
        f'<script>{script}</script></body></html>\n'
    )


def section(heading: str, content: str) -> str:
    """HTML of a section: a heading, unless it is empty, and HTML content."""
    above = f'<h2>{escape(heading)}</h2>' if heading else ''
    return f'<section>{above}{content}</section>\n'


def drawn(figure: go.Figure, name: str | None = None) -> str:
    """HTML of a figure, for a section; `name` becomes the id of its element."""
    config = {'displaylogo': False, 'responsive': True}
    return str(figure.to_html(config=config, include_plotlyjs=False, full_html=False, div_id=name))


def write_page(path: Path, title: str, lines: Sequence[str], figures: Sequence[go.Figure]) -> None:
    """Writes a plain page atomically.

    Args:
        path: of the HTML file.
        title: of the page.
        lines: text above the figures.
        figures: from top to bottom.

    Raises:
        InputError: the file cannot be written.
    """
    words = escape('\n'.join(lines))
    sections = [section('', f'<pre>{words}</pre>')]
    for figure in figures:
        height = figure.layout.height or HEIGHT
        figure.update_layout(template='simple_white', height=height, margin={'t': 80, 'b': 50})
        sections.append(section('', drawn(figure)))
    write_atomically(path, page(title, sections).encode())
