"""One HTML page of text and figures that needs nothing beside itself."""

import html
from collections.abc import Sequence
from pathlib import Path

import plotly.graph_objects as go
from push_core.atomic_file import write_atomically

HEAD = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title>
<style>body {{ font-family: sans-serif; max-width: 75em; margin: auto; }}</style>
</head><body><h1>{title}</h1><pre>{text}</pre>
"""
COLOURS = ('#3366aa', '#bb5533', '#448844')
DIVERGING = 'RdBu'


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
        figure.update_layout(template='simple_white', height=420, margin={'t': 60, 'b': 50})
        # the drawing code goes into the page once
        parts.append(figure.to_html(full_html=False, include_plotlyjs=number == 0))
    write_atomically(path, ''.join([*parts, '</body></html>\n']).encode())
