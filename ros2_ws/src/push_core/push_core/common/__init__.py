"""General helpers: errors, settings, files, text tables, worker processes, command lines."""

from push_core.common.atomic_file import check_place, write_atomically
from push_core.common.command_line import Parser, describe, run_command
from push_core.common.csv_text import CsvText, number_of, read_csv_text
from push_core.common.errors import InputError, PushError, RunError
from push_core.common.interrupts import (
    INTERRUPTED,
    InterruptsHeld,
    interrupt_is_held,
    take_held_interrupt,
)
from push_core.common.realtime_settings import RealtimeSettings
from push_core.common.settings import (
    Described,
    flatten,
    nested,
    reject_unknown,
    replaced,
    setting,
    unused_names,
    validate,
)
from push_core.common.strict_json import finite, json_text
from push_core.common.text_table import markdown_table, plain_table
from push_core.common.workers import Map, Workers, usable_cores, worker_pool

__all__ = [
    'INTERRUPTED',
    'CsvText',
    'Described',
    'InputError',
    'InterruptsHeld',
    'Map',
    'Parser',
    'PushError',
    'RealtimeSettings',
    'RunError',
    'Workers',
    'check_place',
    'describe',
    'finite',
    'flatten',
    'interrupt_is_held',
    'json_text',
    'markdown_table',
    'nested',
    'number_of',
    'plain_table',
    'read_csv_text',
    'reject_unknown',
    'replaced',
    'run_command',
    'setting',
    'take_held_interrupt',
    'unused_names',
    'usable_cores',
    'validate',
    'worker_pool',
    'write_atomically',
]
