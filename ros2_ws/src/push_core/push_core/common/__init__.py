"""What is not about pushing: errors, settings, files, worker processes, command lines."""

from push_core.common.atomic_file import check_place, write_atomically
from push_core.common.command_line import Parser, describe, run_command
from push_core.common.errors import InputError, PushError, RunError
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
from push_core.common.workers import Map, usable_cores, workers

__all__ = [
    'Described',
    'InputError',
    'Map',
    'Parser',
    'PushError',
    'RunError',
    'check_place',
    'describe',
    'finite',
    'flatten',
    'json_text',
    'nested',
    'reject_unknown',
    'replaced',
    'run_command',
    'setting',
    'unused_names',
    'usable_cores',
    'validate',
    'workers',
    'write_atomically',
]
