"""One HTML page of text and figures that needs nothing beside itself.

It imports plotly, which the rest of this package does without: import it only for a page.
"""

import html
from collections.abc import Sequence
from pathlib import Path

import plotly.graph_objects as go

from push_core.atomic_file import write_atomically

HEAD = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title>
<style>
body {{ font: 15px/1.45 system-ui, "DejaVu Sans", sans-serif; max-width: 75em; margin: auto;
       padding: 1.5em; color: #1f2933; }}
h1 {{ font-size: 26px; margin: 0 0 0.6em; }}
pre {{ background: #f4f6f8; border-radius: 8px; padding: 1em 1.2em; overflow-x: auto;
      font-size: 13px; }}
</style>
</head><body><h1>{title}</h1><pre>{text}</pre>
"""
COLOURS = ('#3366aa', '#bb5533', '#448844')
DIVERGING = 'RdBu'
HEIGHT = 420


def write_page(path: Path, title: str, lines: Sequence[str], figures: Sequence[go.Figure]) -> None:
    """Writes a page; whole or not at all.

    Args:
        path: of the HTML file.
        title: of the page.
        lines: figures in words, above the pictures.
        figures: the pictures, top to bottom.

    Raises:
        InputError: the file cannot be written.
    """
    parts = [HEAD.format(title=html.escape(title), text=html.escape('\n'.join(lines)))]
    for number, figure in enumerate(figures):
        height = figure.layout.height or HEIGHT
        figure.update_layout(template='simple_white', height=height, margin={'t': 80, 'b': 50})
        # the drawing code goes into the page once
        parts.append(figure.to_html(full_html=False, include_plotlyjs=number == 0))
    write_atomically(path, ''.join([*parts, '</body></html>\n']).encode())
