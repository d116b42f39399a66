"""YAML by libyaml where PyYAML was built with it: ten times as fast."""

from typing import Any

import yaml

_LOADER: Any = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)
_DUMPER: Any = getattr(yaml, 'CSafeDumper', yaml.SafeDumper)


def from_yaml(text: str) -> Any:
    """The plain objects that a text describes.

    Raises:
        yaml.YAMLError: it is no YAML.
    """
    return yaml.load(text, Loader=_LOADER)


def to_yaml(value: Any) -> str:
    """The text of plain objects, in their own order."""
    return str(yaml.dump(value, Dumper=_DUMPER, sort_keys=False))
