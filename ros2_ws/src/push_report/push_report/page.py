"""One HTML page of text and plotly figures that needs nothing beside itself, also offline.

It imports plotly, which the rest of this package does without: import it only for a page.
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
    """The page.

    Args:
        title: of the page.
        sections: HTML of each, see `section`; figures without the drawing library.
        head: HTML above the sections; default: the title.
        script: JavaScript that runs when all is there.
        library: JavaScript that draws; default: plotly.js as a whole.
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
    """A part of the page under its heading, if it has one; the content is HTML."""
    above = f'<h2>{escape(heading)}</h2>' if heading else ''
    return f'<section>{above}{content}</section>\n'


def drawn(figure: go.Figure, name: str | None = None) -> str:
    """HTML of a figure, for a section; `name` becomes the id of its element."""
    config = {'displaylogo': False, 'responsive': True}
    return str(figure.to_html(config=config, include_plotlyjs=False, full_html=False, div_id=name))


def write_page(path: Path, title: str, lines: Sequence[str], figures: Sequence[go.Figure]) -> None:
    """Writes a plain page; whole or not at all.

    Args:
        path: of the HTML file.
        title: of the page.
        lines: figures in words, above the pictures.
        figures: the pictures, top to bottom.

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
