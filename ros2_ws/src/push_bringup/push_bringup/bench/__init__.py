"""The benchmarks, one module each, and their tables and pages."""

from push_bringup.bench.benches import BENCHES
from push_bringup.bench.options import (
    add_controllers,
    add_lap_options,
    check_positive,
    opened_store,
    print_results,
)
from push_bringup.bench.rows import MismatchRow
from push_bringup.bench.tables import (
    TABLES,
    BenchResults,
    experiment_name,
    markdown_table,
    mismatch_rows,
    time_ranges,
)

__all__ = [
    'BENCHES',
    'TABLES',
    'BenchResults',
    'MismatchRow',
    'add_controllers',
    'add_lap_options',
    'check_positive',
    'experiment_name',
    'markdown_table',
    'mismatch_rows',
    'opened_store',
    'print_results',
    'time_ranges',
]
