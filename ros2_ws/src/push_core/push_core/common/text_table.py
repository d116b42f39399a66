"""Tables of text cells: plain columns for a terminal, or Markdown.

Written here because the library `tabulate` would add a package, its type stubs and a dependency of
five manifests for these lines.
"""

from collections.abc import Iterable, Sequence

GAP = '  '


def plain_table(rows: Iterable[Sequence[str]], left: int = 1) -> list[str]:
    """Lines of a table whose columns are as wide as their widest cells.

    Args:
        rows: cells of each row; all rows have the same number.
        left: how many columns are aligned left; the others, of numbers, are aligned right.
    """
    table = list(rows)
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    return [
        GAP.join(
            cell.ljust(width) if column < left else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in table
    ]


def markdown_table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    """Lines of a Markdown table under the column titles `head`."""
    lines = [f'| {" | ".join(cells)} |' for cells in (head, *rows)]
    return [lines[0], '|' + '---|' * len(head), *lines[1:]]
