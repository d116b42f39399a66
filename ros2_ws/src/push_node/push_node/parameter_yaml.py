"""Values of parameters in YAML, with the numbers that ROS takes."""

import re
from typing import Any

import yaml

_EXPONENT = re.compile(r'[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+')


class _Loader(yaml.SafeLoader):
    """PyYAML without its demand for a point and a sign in `5e-2` and `1.0e5`."""


_Loader.add_implicit_resolver(
    'tag:yaml.org,2002:float', re.compile(f'{_EXPONENT.pattern}$'), list('-+.0123456789')
)


def load_yaml(text: str) -> Any:
    """The value of a text.

    Raises:
        yaml.YAMLError: it is not YAML.
    """
    return yaml.load(text, _Loader)
