"""Python class, schema text and type hash of installed message types."""

import functools
import importlib
import json
import os
import re
from pathlib import Path
from typing import Any, NamedTuple

from push_core.common import InputError

from push_bag.file.cdr_layout import SEPARATOR

INTEGERS = {f'{sign}int{bits}' for sign in ('', 'u') for bits in (8, 16, 32, 64)}
PRIMITIVES = INTEGERS | {'bool', 'byte', 'char', 'float32', 'float64', 'string', 'wstring'}


class Definition(NamedTuple):
    """A type's `ros2msg` schema, and its REP-2011 hash; the hash is empty if unknown."""

    schema: str
    type_hash: str


def installed_definition(type_name: str) -> Definition:
    """The definition of an installed message type.

    Raises:
        InputError: it is not installed.
    """
    return Definition(schema_text(type_name), type_hash(type_name))


@functools.cache
def message_class(type_name: str) -> Any:
    """The Python class of a message type.

    Args:
        type_name: in three parts, `geometry_msgs/msg/PoseStamped`.

    Raises:
        InputError: no such message is installed.
    """
    package, folder, name = _parts(type_name)
    try:
        return getattr(importlib.import_module(f'{package}.{folder}'), name)
    except (ImportError, AttributeError, ValueError):
        raise InputError(
            f'message type {type_name} is not installed; build and source its package'
        ) from None


@functools.cache
def schema_text(type_name: str) -> str:
    """The `ros2msg` schema: the type's own definition, then those of all nested types.

    Raises:
        InputError: a definition is not installed.
    """
    sections = [_definition(type_name)]
    sections += [
        # fields name their types without the folder, and readers look them up by that name
        f'MSG: {name.replace("/msg/", "/")}\n{_definition(name)}'
        for name in _dependencies(type_name)
    ]
    return f'\n{SEPARATOR}\n'.join(sections)


@functools.cache
def type_hash(type_name: str) -> str:
    """The REP-2011 hash of the type, `RIHS01_…`, from its installed description.

    Raises:
        InputError: the type's description is not installed.
    """
    described = json.loads(_shared_file(type_name, '.json').read_text(encoding='utf-8'))
    hashes = {entry['type_name']: entry['hash_string'] for entry in described['type_hashes']}
    return str(hashes[type_name])


def _dependencies(type_name: str) -> list[str]:
    """All nested types of a type, at any depth, each once, breadth first."""
    found: list[str] = []
    waiting = _field_types(type_name)
    while waiting:
        name = waiting.pop(0)
        if name not in found:
            found.append(name)
            waiting += _field_types(name)
    return found


def _field_types(type_name: str) -> list[str]:
    """The message types among the types of a message's own fields."""
    package = _parts(type_name)[0]
    words = (line.split('#')[0].split() for line in _definition(type_name).splitlines())
    bases = [re.split(r'\[|<=', line[0])[0] for line in words if line]
    return [_full_name(base, package) for base in bases if base not in PRIMITIVES]


def _full_name(base: str, package: str) -> str:
    owner, _, name = base.rpartition('/')
    return f'{owner.removesuffix("/msg") or package}/msg/{name}'


def _definition(type_name: str) -> str:
    return _shared_file(type_name, '.msg').read_text(encoding='utf-8')


def _shared_file(type_name: str, suffix: str) -> Path:
    package, folder, name = _parts(type_name)
    for prefix in os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep):
        path = Path(prefix, 'share', package, folder, name + suffix)
        if path.is_file():
            return path
    raise InputError(
        f'the definition of {type_name} is not installed; build and source its package'
    )


def _parts(type_name: str) -> list[str]:
    parts = type_name.split('/')
    if len(parts) != 3:
        raise InputError(f'{type_name!r} is not a message type such as geometry_msgs/msg/Pose')
    return parts
