"""The benchmarks, one module each, and their tables and pages."""

from push_bringup.bench.benches import BENCHES
from push_bringup.bench.options import check_positive
from push_bringup.bench.tables import TABLES, Found, experiment_name, markdown_table, time_ranges

__all__ = [
    'BENCHES',
    'TABLES',
    'Found',
    'check_positive',
    'experiment_name',
    'markdown_table',
    'time_ranges',
]
