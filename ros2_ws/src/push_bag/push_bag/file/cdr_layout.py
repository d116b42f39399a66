"""The fields of a message type in the order of CDR, parsed from its schema."""

import re
from dataclasses import dataclass

from push_core.common import InputError

SEPARATOR = '=' * 80  # between the definitions in a schema
DTYPES = {
    'bool': 'u1',
    'byte': 'u1',
    'char': 'u1',
    'float32': '<f4',
    'float64': '<f8',
    **{f'int{bits}': f'<i{bits // 8}' for bits in (8, 16, 32, 64)},
    **{f'uint{bits}': f'<u{bits // 8}' for bits in (8, 16, 32, 64)},
}
DEEPEST = 20  # levels of nesting; more means that a type contains itself
# constants have upper-case names and do not match
_FIELD = re.compile(
    r'^(?P<base>[A-Za-z]\w*(?:/\w+)*)(?:<=\d+)?(?P<array>\[[^\]]*\])?\s+(?P<name>[a-z]\w*)'
)


@dataclass(frozen=True)
class Leaf:
    """A field of primitive type, or an array of unknown size.

    Attributes:
        name: path in the message, such as `header.stamp.sec`.
        dtype: of numpy; `str` for a string, empty for a field without a fixed size.
        count: length of a fixed array, else 1.
    """

    name: str
    dtype: str
    count: int


def leaves(schema: str, package: str) -> list[Leaf]:
    """All primitive fields of a message type, nested ones by their path.

    Args:
        schema: `ros2msg` text with the definitions of all nested types.
        package: of the type.

    Raises:
        InputError: a nested type is not defined in the schema, or contains itself.
    """
    main, *others = schema.split(f'\n{SEPARATOR}\n')
    texts = {}
    for section in others:
        heading, _, text = section.partition('\n')
        texts[_two_parts(heading.removeprefix('MSG: ').strip())] = text
    return _leaves(main, package, '', texts, 0)


def _leaves(text: str, package: str, prefix: str, texts: dict[str, str], depth: int) -> list[Leaf]:
    if depth > DEEPEST:
        raise InputError('a message type of the bag contains itself')
    found: list[Leaf] = []
    for line in text.splitlines():
        field = _FIELD.match(line.strip())
        if field is not None:
            found += _leaves_of(field, package, prefix, texts, depth)
    return found


def _leaves_of(
    field: 're.Match[str]', package: str, prefix: str, texts: dict[str, str], depth: int
) -> list[Leaf]:
    base, array, name = field['base'], field['array'] or '', prefix + field['name']
    fixed = re.fullmatch(r'\[(\d+)\]', array)
    if DTYPES.get(base) and (fixed or not array):
        return [Leaf(name, DTYPES[base], int(fixed[1]) if fixed else 1)]
    if base == 'string' and not array:
        return [Leaf(name, 'str', 1)]
    if base in ('string', 'wstring') or array or DTYPES.get(base):
        return [Leaf(name, '', 1)]
    full = base if '/' in base else f'{package}/{base}'
    nested = texts.get(_two_parts(full))
    if nested is None:
        raise InputError(f'the bag does not define the message type {base}')
    return _leaves(nested, full.split('/')[0], f'{name}.', texts, depth + 1)


def _two_parts(type_name: str) -> str:
    """`std_msgs/Header` for `std_msgs/msg/Header`; schemas use both forms."""
    return type_name.replace('/msg/', '/')
