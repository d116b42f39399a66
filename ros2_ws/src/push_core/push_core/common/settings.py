"""Settings: frozen dataclasses whose fields carry description, unit and range.

A component declares its parameters as a frozen dataclass of `setting` fields and nested settings.
Names of nested ones are dotted: `actuator.dead_time`.
"""

import dataclasses
import math
from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

from push_core.common.errors import InputError

T = TypeVar('T')


@dataclasses.dataclass(frozen=True)
class Described:
    """Description, unit and range of a field of a settings class."""

    text: str
    unit: str
    low: float
    high: float
    choices: tuple[str, ...]

    @property
    def is_bounded(self) -> bool:
        """Whether not every value is allowed."""
        return bool(self.choices) or math.isfinite(self.low) or math.isfinite(self.high)

    def range_text(self) -> str:
        """Allowed values in words, for errors and documentation."""
        if self.choices:
            return 'one of ' + ', '.join(self.choices)
        unit = f' {self.unit}' if self.unit else ''
        return f'between {self.low:g} and {self.high:g}{unit}'


def setting(
    default: Any,
    text: str,
    *,
    unit: str = '',
    low: float = -math.inf,
    high: float = math.inf,
    choices: tuple[str, ...] = (),
) -> Any:
    """One field of a settings class.

    Args:
        default: value; its type is the type of the field.
        text: one phrase that describes it.
        unit: SI unit, '' without one.
        low: smallest allowed number.
        high: largest allowed number.
        choices: allowed values of a text field.
    """
    described = Described(text, unit, low, high, choices)
    return dataclasses.field(default=default, metadata={'described': described})


def nested(default: Any, unused: Mapping[str, str] | None = None) -> Any:
    """A field that holds another settings object.

    Args:
        default: that object.
        unused: fields that the component does not read, each with the reason or an alternative.
            They are not parameters of the component and keep their defaults.
    """
    return dataclasses.field(
        default_factory=lambda: default, metadata={'unused': dict(unused or {})}
    )


def flatten(settings: Any, prefix: str = '') -> dict[str, tuple[Any, Described]]:
    """All values of a settings object by dotted name, each with its description."""
    flat: dict[str, tuple[Any, Described]] = {}
    for field in dataclasses.fields(settings):
        value = getattr(settings, field.name)
        name = prefix + field.name
        if dataclasses.is_dataclass(value):
            inner = flatten(value, name + '.')
            for hidden in field.metadata.get('unused', ()):
                del inner[f'{name}.{hidden}']
            flat.update(inner)
        else:
            flat[name] = (value, field.metadata['described'])
    return flat


def unused_names(settings: Any) -> dict[str, str]:
    """Dotted names of the unused fields (see `nested`), with the reason or an alternative."""
    return {
        f'{field.name}.{name}': instead
        for field in dataclasses.fields(settings)
        for name, instead in field.metadata.get('unused', {}).items()
    }


def reject_unknown(names: Iterable[str], settings: Any, owner: str = '') -> None:
    """Checks that all dotted names are parameters of a settings object.

    Args:
        names: to check.
        settings: the object.
        owner: of the parameters, for the error message; '' leaves it out.

    Raises:
        InputError: names the parameter, and the known ones or the alternative.
    """
    known, instead = flatten(settings), unused_names(settings)
    of = f' of {owner}' if owner else ''
    for name in names:
        if name in instead:
            raise InputError(f'parameter {name!r}{of} would have no effect: {instead[name]}')
        if name not in known:
            raise InputError(f'unknown parameter {name!r}{of}; known: {", ".join(sorted(known))}')


def replaced(settings: T, changes: Mapping[str, Any], owner: str = '') -> T:
    """A copy with some dotted names changed, checked.

    Args:
        settings: to be copied.
        changes: values by dotted name.
        owner: see `reject_unknown`.

    Raises:
        InputError: an unknown name, a wrong type or a value out of range.
    """
    reject_unknown(changes, settings, owner)
    return _replaced(settings, changes, '')


def _replaced(settings: T, changes: Mapping[str, Any], prefix: str) -> T:
    values = {}
    for field in dataclasses.fields(settings):  # type: ignore[arg-type]
        old = getattr(settings, field.name)
        name = prefix + field.name
        if dataclasses.is_dataclass(old):
            values[field.name] = _replaced(old, changes, name + '.')
        else:
            described = field.metadata['described']
            values[field.name] = checked(name, changes.get(name, old), old, described)
    return type(settings)(**values)


def checked(name: str, value: Any, like: Any, described: Described) -> Any:
    """The value, converted to the type of `like`, if it is in range.

    Raises:
        InputError: names the parameter, the value and its range.
    """
    if isinstance(like, float) and isinstance(value, int) and not isinstance(value, bool):
        value = float(value)
    if isinstance(like, str) and type(value) in (int, float):
        value = f'{value:g}'
    if type(value) is not type(like):
        raise InputError(f'parameter {name} takes {type(like).__name__}, not {value!r}')
    if described.choices and value not in described.choices:
        raise InputError(f'parameter {name} is {value!r}, must be {described.range_text()}')
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if is_number and not described.low <= value <= described.high:
        raise InputError(f'parameter {name} is {value:g}, must be {described.range_text()}')
    return value


def validate(settings: Any) -> None:
    """Checks every value of a settings object; call it from `__post_init__`.

    Raises:
        InputError: names the parameter and its range.
    """
    for name, (value, described) in flatten(settings).items():
        checked(name, value, value, described)
