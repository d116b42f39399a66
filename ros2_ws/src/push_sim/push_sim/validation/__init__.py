"""The plant beside measurements: errors, tables, pages."""

from push_sim.validation.as_json import as_json
from push_sim.validation.as_table import validation_table
from push_sim.validation.comparison import Validation, validation

__all__ = ['Validation', 'as_json', 'validation', 'validation_table']
