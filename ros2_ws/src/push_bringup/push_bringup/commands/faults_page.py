"""`faults --html`: what the faults led to, as a page."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from push_core.common import write_atomically
from push_report.page import page, section, table

from push_bringup.faults import Verdict

HEADS = ('fault', 'must', 'as expected', 'rest', 'allowed', 'fastest', 'again', 'kind')
TEXT = (
    'Each fault is put into running cells at random moments of a lap. Rest: the longest time '
    'until the tip is slower than 5 mm/s. Fastest: the largest speed of the tip. Again: cases '
    'that were repeated, because the host had taken the cores away from the campaign.'
)
NONE = '<p>Every case led to what it must.</p>'


def write_page(path: Path, verdicts: Sequence[Verdict], results: Mapping[str, Any]) -> None:
    """Writes the page atomically.

    Args:
        path: of the HTML file.
        verdicts: of all cases.
        results: their `summary`.

    Raises:
        InputError: the file cannot be written.
    """
    failed = [
        [verdict.case.kind, verdict.case.mode, str(verdict.case.seed), '; '.join(verdict.problems)]
        for verdict in verdicts
        if verdict.problems
    ]
    listed = table(('kind', 'mode', 'seed', 'what'), failed) if failed else NONE
    rows = [_cells(kind, row) for kind, row in results['by_fault'].items()]
    sections = [
        section('By fault', table(HEADS, rows), TEXT),
        section('Not as expected', listed),
    ]
    write_atomically(path, page('Faults in running cells', sections).encode())


def _cells(kind: str, row: Mapping[str, Any]) -> list[str]:
    return [
        row['text'],
        row['expected'],
        f'{row["as_expected"]} of {row["cases"]}',
        _seconds(row['longest_rest_s']),
        _seconds(row['allowed_rest_s']),
        f'{row["fastest_m_s"]:.3f} m/s',
        str(row['again']),
        kind,
    ]


def _seconds(value: float | None) -> str:
    return '–' if value is None else f'{value:.2f} s'
