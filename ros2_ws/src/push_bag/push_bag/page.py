"""One HTML page with plotly figures that needs nothing else, also offline."""

from collections.abc import Sequence
from html import escape
from importlib.resources import files

from plotly.offline import get_plotlyjs


def page(title: str, sections: Sequence[str], head: str = '', script: str = '') -> str:
    """The page.

    Args:
        title: of the page.
        sections: HTML of each, see `section`; figures without the drawing library.
        head: HTML above the sections; default: the title.
        script: JavaScript that runs when all is there.
    """
    above = head or f'<h1>{escape(title)}</h1>'
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<title>{escape(title)}</title><style>{resource("report.css")}</style>'
        f'<script>{get_plotlyjs()}</script></head>\n<body>{above}{"".join(sections)}'
        f'<script>{script}</script></body></html>\n'
    )


def section(heading: str, content: str) -> str:
    """A part of the page under its heading; the content is HTML."""
    return f'<section><h2>{escape(heading)}</h2>{content}</section>\n'


def resource(name: str) -> str:
    """The text of a file that lies beside this module."""
    return files('push_bag').joinpath(name).read_text(encoding='utf-8')
