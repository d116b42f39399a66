"""Comparison of the plant with measurements: figures, table, page."""

from push_sim.validation.comparison import Validation, compare_with_measurements
from push_sim.validation.output import (
    validation_json,
    validation_rows,
    validation_table,
    write_validation_page,
)

__all__ = [
    'Validation',
    'compare_with_measurements',
    'validation_json',
    'validation_rows',
    'validation_table',
    'write_validation_page',
]
