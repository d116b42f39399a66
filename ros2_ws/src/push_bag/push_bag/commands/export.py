"""`push_bag export RUN --csv|--parquet -o FILE`: writes a run as one table."""

import argparse
import csv
import io
import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from push_core.common import InputError, Parser, run_command, write_atomically

from push_bag.run import RunSeries, read_starts
from push_bag.score import TickTable, tick_table

EPILOG = """
One row per tick of the controller, in SI units; column names end with the unit, except v_n, v_t
and their nominal values [m/s]. Cells without a value are empty (CSV) or null (Parquet).
--parquet needs pyarrow: `make setup EXTRA=parquet`.
Example: ros2 run push_bag export runs/RUN --csv -o run.csv
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Exports a run."""
    return run_command(_parser(), _work, argv)


def csv_bytes(table: TickTable) -> bytes:
    """The table as CSV; numbers are written with all their digits."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator='\n')
    writer.writerow(table)
    columns = (_texts(column) for column in table.values())
    writer.writerows(zip(*columns, strict=True))
    return text.getvalue().encode()


def parquet_bytes(table: TickTable) -> bytes:
    """The table as Parquet.

    Raises:
        InputError: pyarrow is not installed.
    """
    try:
        # a large library that only this option needs
        import pyarrow  # noqa: PLC0415
        import pyarrow.parquet  # noqa: PLC0415
    except ImportError:
        raise InputError('--parquet needs pyarrow: run `make setup EXTRA=parquet`') from None
    columns = {name: pyarrow.array(each, from_pandas=True) for name, each in table.items()}
    sink = io.BytesIO()
    pyarrow.parquet.write_table(pyarrow.table(columns), sink)
    return sink.getvalue()


def _texts(column: NDArray[np.float64] | NDArray[np.int64]) -> list[str]:
    return ['' if math.isnan(value) else repr(value) for value in column.tolist()]


def _parser() -> Parser:
    parser = Parser('Writes a run as one table, one row per tick.', EPILOG)
    parser.add_argument('run', type=Path, help='run folder or MCAP file')
    kind = parser.add_mutually_exclusive_group(required=True)
    for name, write in (('csv', csv_bytes), ('parquet', parquet_bytes)):
        kind.add_argument(
            f'--{name}', dest='write', action='store_const', const=write, help=f'as {name.upper()}'
        )
    parser.add_argument(
        '--start', type=int, metavar='N', help='the start to write, from 1, of a bag with several'
    )
    parser.add_argument(
        '-o', '--output', type=Path, required=True, metavar='FILE', help='the file to write'
    )
    return parser


def _work(arguments: argparse.Namespace) -> None:
    table = tick_table(_chosen(read_starts(arguments.run), arguments.start))
    write_atomically(arguments.output, arguments.write(table))
    sys.stdout.write(f'{len(table["t_s"])} rows\n{arguments.output}\n')


def _chosen(starts: Sequence[RunSeries], number: int | None) -> RunSeries:
    """The start with a number, or the only one.

    Raises:
        InputError: there is no such start, or none was chosen of several.
    """
    if number is None and len(starts) > 1:
        raise InputError(f'the bag holds {len(starts)} starts; choose one with --start')
    chosen = 1 if number is None else number
    if not 1 <= chosen <= len(starts):
        raise InputError(f'there is no start {chosen}: the bag holds {len(starts)}')
    return starts[chosen - 1]


if __name__ == '__main__':
    sys.exit(main())
