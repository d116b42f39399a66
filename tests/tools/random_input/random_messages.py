"""Random messages of any type: well-formed, with every kind of number."""

import math
import random
import re
from collections.abc import Callable
from pkgutil import resolve_name
from typing import Any

ODD = (0.0, -0.0, 1.0, -1.0, 5e-324, 1e308, -1e308, math.nan, math.inf, -math.inf)
LONGEST = 5  # entries of a sequence
INTEGER = re.compile(r'(u?)int(\d+)')
ARRAY = re.compile(r'(.+)\[(\d+)\]')
SEQUENCE = re.compile(r'sequence<(.+?)(?:, \d+)?>')
TEXTS = ('', 'world', 'map', 'stop', '/mpc_node', 'ä' * 40)


def _number(chance: random.Random) -> float:
    return chance.choice((chance.uniform(-1.0, 1.0), chance.choice(ODD)))


PLAIN: dict[str, Callable[[random.Random], Any]] = {
    'float': _number,
    'double': _number,
    'boolean': lambda chance: chance.random() < 0.5,
    'octet': lambda chance: bytes([chance.randrange(256)]),
    'string': lambda chance: chance.choice(TEXTS),
}


def random_message(kind: Any, chance: random.Random) -> Any:
    """A message, request or response of a class."""
    message = kind()
    for name, field in kind.get_fields_and_field_types().items():
        setattr(message, name, random_value(field, chance))
    return message


def random_value(field: str, chance: random.Random) -> Any:
    """A value of a field's type, as `get_fields_and_field_types` states it."""
    if found := ARRAY.fullmatch(field):
        return [random_value(found[1], chance) for _ in range(int(found[2]))]
    if found := SEQUENCE.fullmatch(field):
        return [random_value(found[1], chance) for _ in range(chance.randrange(LONGEST))]
    if found := INTEGER.fullmatch(field):
        return chance.choice((0, 1, chance.getrandbits(int(found[2]) - (not found[1]))))
    if '/' in field:
        package, name = field.split('/')
        return random_message(resolve_name(f'{package}.msg:{name}'), chance)
    return PLAIN[field](chance)
