"""Parameters of a node, declared from its settings class."""

from typing import Any, TypeVar

from push_core.common import Described, flatten, reject_unknown, replaced
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node

T = TypeVar('T')
_NOT_OURS = ('use_sim_time', 'qos_overrides.', 'start_type_description_service')


def declared(node: Node, defaults: T) -> T:
    """Declares every value of a settings object as a parameter; returns the settings in effect.

    Args:
        node: the node that owns the parameters.
        defaults: settings made with `push_core.common.settings`.

    Returns:
        The settings with the overrides of command line and parameter file.

    Raises:
        InputError: an unknown parameter, a wrong type or a value out of range.
    """
    # rclpy ignores overrides of parameters that the node does not have
    given = (name for name in node._parameter_overrides if not name.startswith(_NOT_OURS))
    reject_unknown(given, defaults, node.get_name())
    changes = {
        name: _declare(node, name, value, described)
        for name, (value, described) in flatten(defaults).items()
    }
    return replaced(defaults, changes)


def override(node: Node, name: str, default: T) -> T:
    """The override of one parameter before it is declared; `default` if there is none."""
    found = node._parameter_overrides.get(name)
    return default if found is None else found.value


def _declare(node: Node, name: str, value: Any, described: Described) -> Any:
    descriptor = ParameterDescriptor(
        description=described.text,
        additional_constraints=described.range_text(),
        read_only=True,
        dynamic_typing=True,
    )
    return node.declare_parameter(name, value, descriptor).value
