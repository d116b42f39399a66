"""The benchmarks, one module each, and their tables and pages."""

from push_bringup.bench.benches import BENCHES
from push_bringup.bench.options import check_positive
from push_bringup.bench.tables import (
    TABLES,
    BenchResults,
    experiment_name,
    markdown_table,
    time_ranges,
)

__all__ = [
    'BENCHES',
    'TABLES',
    'BenchResults',
    'check_positive',
    'experiment_name',
    'markdown_table',
    'time_ranges',
]
