"""The lines of a CSV file in whatever dialect other programs write it.

Read are: comma, semicolon, tab or blanks between the values, a decimal comma beside the latter
three, lines of comment that begin with `#`, a line of names behind `#`, quotes, blank lines, a
byte order mark, CRLF. The module csv of the standard library splits the lines; its Sniffer
guesses, where the names of the columns that we look for decide.
"""

import csv
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from push_core.common.errors import InputError

DELIMITERS = (',', ';', '\t')
COMMENT = '#'


@dataclass(frozen=True)
class CsvText:
    """The cells of a file.

    Attributes:
        path: of the file.
        names: of the columns, in lower case; none where the first line holds numbers.
        names_line: number of the line that names them, 1 without names.
        rows: line number and cells of each row below.
    """

    path: Path
    names: Sequence[str]
    names_line: int
    rows: Sequence[tuple[int, list[str]]]


def read_csv_text(path: Path, known: Collection[str], at_least: int = 1) -> CsvText:
    """Splits a file into cells.

    Args:
        path: of the file.
        known: names of columns, in lower case, by which a line of names is recognised.
        at_least: number of them that a line of names holds; more tell it from a comment.

    Raises:
        InputError: the file cannot be read, or is no text.
    """
    lines = _lines(path)
    header = next((line for line in lines if _names(line[1], known, at_least)), None)
    first = next((line for line in lines if not line[1].startswith(COMMENT)), (1, ''))
    delimiter = _delimiter((header or first)[1], known)
    plain = [line for line in lines if line != header and not line[1].startswith(COMMENT)]
    rows = [(number, _cells(text, delimiter)) for number, text in plain]
    if header:
        names = [name.lower() for name in _cells(header[1].lstrip(COMMENT + ' '), delimiter)]
        rows = [row for row in rows if row[0] > header[0]]
        return CsvText(path, names, header[0], rows)
    if rows and not any(map(is_number, rows[0][1])):
        (number, names), *rows = rows
        return CsvText(path, [name.lower() for name in names], number, rows)
    return CsvText(path, (), first[0], rows)


def is_number(cell: str) -> bool:
    """Whether a cell is a number, be it not a finite one."""
    try:
        number_of(cell)
    except ValueError:
        return False
    return True


def number_of(cell: str) -> float:
    """The number in a cell.

    Raises:
        ValueError: it holds none; `1_000`, which Python would take, is none.
    """
    if '_' in cell:
        raise ValueError(cell)
    return float(cell)


def _lines(path: Path) -> list[tuple[int, str]]:
    """Number and text of the lines that are not blank."""
    try:
        text = path.read_text(encoding='utf-8-sig')
    except OSError as error:
        raise InputError(f'cannot read {path}: {error.strerror}') from error
    except UnicodeDecodeError as error:
        raise InputError(f'{path}: is not a CSV text file ({error})') from error
    if '\0' in text:
        raise InputError(f'{path}: is not a CSV text file (it holds NUL bytes)')
    numbered = enumerate(text.splitlines(), start=1)
    return [(number, line.strip(' ')) for number, line in numbered if line.strip(' \t,;')]


def _names(line: str, known: Collection[str], at_least: int) -> bool:
    """Whether a line, be it a comment, names so many columns that are known."""
    text = line.lstrip(COMMENT + ' ')
    return any(_found(text, mark, known) >= at_least for mark in _marks(text))


def _found(text: str, mark: str, known: Collection[str]) -> int:
    return len({cell.lower() for cell in _cells(text, mark)} & {*known})


def _marks(text: str) -> Sequence[str]:
    """The delimiters of a line; blanks only without another one."""
    return [mark for mark in DELIMITERS if mark in text] or [' ']


def _delimiter(line: str, known: Collection[str]) -> str:
    """The one that yields most known names, or else most cells; a decimal comma is none."""
    text = line.lstrip(COMMENT + ' ')

    def merit(mark: str) -> tuple[int, bool, int]:
        cells = _cells(text, mark)
        return _found(text, mark, known), mark != ',' and len(cells) > 1, len(cells)

    return max(_marks(text), key=merit)


def _cells(line: str, delimiter: str) -> list[str]:
    try:
        (cells,) = csv.reader([line], delimiter=delimiter, skipinitialspace=True)
    except (csv.Error, ValueError):
        return [line]
    stripped = [cell.strip() for cell in cells]
    if delimiter == ',':
        return stripped
    return [_with_point(cell) for cell in stripped]


def _with_point(cell: str) -> str:
    """A number with a decimal comma as Python writes it."""
    if cell.count(',') != 1 or '.' in cell:
        return cell
    pointed = cell.replace(',', '.')
    return pointed if is_number(pointed) else cell
