"""Reads a bag into the time series that score and report use."""

from pathlib import Path

from push_core.common import InputError

from push_bag.file import BagReader
from push_bag.run.run_rows import RunRows
from push_bag.run.series import RunSeries


def read_run(path: Path) -> RunSeries:
    """Reads a bag with one start of the controller, or the last start of a bag with several.

    Args:
        path: run folder or MCAP file.

    Raises:
        InputError: there is no bag, or it is not readable.
    """
    return read_starts(path)[-1]


def read_starts(path: Path) -> list[RunSeries]:
    """Reads each start of the controller in a bag as a run of its own.

    Decodes only the fields that the score needs. A bag without a start is one run with all that
    it holds. The message counts of each run are those of the bag.

    Args:
        path: run folder or MCAP file.

    Raises:
        InputError: there is no bag, or it is not readable.
    """
    reader = BagReader(path)
    rows = RunRows()
    for record in reader.records():
        rows.add(record)
    if rows.is_empty:
        raise InputError(f'{reader.path} holds no messages')
    starts = rows.starts()
    # the cell ends a run in its last start
    return [
        rows.series(reader, start, rows.end_reason if start is starts[-1] else '')
        for start in starts
    ]
