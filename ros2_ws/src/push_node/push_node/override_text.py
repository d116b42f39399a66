"""Parameter overrides on a command line: `-p NAME:=VALUE`."""

import yaml
from push_core.common import InputError

from push_node.parameter_yaml import load_yaml


def parsed_override(text: str) -> tuple[str, object]:
    """Name and value of an override.

    Args:
        text: `NAME:=VALUE`, the value in YAML as ROS takes it.

    Raises:
        InputError: the text has another form.
    """
    name, separator, value = text.partition(':=')
    if not (name and separator and value):
        raise InputError(f'-p {text}: write it as NAME:=VALUE')
    try:
        # ROS names the node of a parameter with a colon
        return name.lstrip('/').replace(':', '.', 1), load_yaml(value)
    except yaml.YAMLError:
        raise InputError(f'-p {text}: the value is not a number, word or true/false') from None
