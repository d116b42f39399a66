"""Parameters of a node, declared from its settings class."""

from collections.abc import Callable, Collection, Sequence
from typing import Any, TypeVar

from push_core.common import Described, InputError, flatten, reject_unknown, replaced
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

T = TypeVar('T')
NOT_OURS = ('use_sim_time', 'qos_overrides.', 'start_type_description_service')
"""Beginnings of the names of parameters that rclpy declares itself."""


def declared(node: Node, defaults: T, changeable: Collection[str] = ()) -> T:
    """Declares every value of a settings object as a parameter; returns the settings in effect.

    Args:
        node: owns the parameters; made with `automatically_declare_parameters_from_overrides`, or
            else unknown overrides pass unnoticed.
        defaults: settings made with `push_core.common.settings`.
        changeable: names of parameters that may change while the node runs; see `on_change`.

    Returns:
        The settings with the overrides of command line and parameter file.

    Raises:
        InputError: an unknown parameter, a wrong type or a value out of range.
    """
    check_sim_time(node.get_parameter('use_sim_time').value)
    given = node.get_parameters_by_prefix('')
    ours = (name for name in given if not name.startswith(NOT_OURS))
    reject_unknown(ours, defaults, node.get_name())
    changes = {
        name: _declare(node, name, value, described, name not in changeable)
        for name, (value, described) in flatten(defaults).items()
    }
    return replaced(defaults, changes)


def on_change(node: Node, settings: T, apply: Callable[[T], None]) -> None:
    """Checks changes of parameters together, and applies them between two callbacks.

    Args:
        node: owns the parameters.
        settings: in effect.
        apply: takes the changed settings; must not wait.
    """
    current = settings

    def changed(parameters: Sequence[Parameter]) -> T:
        ours = (each for each in parameters if not each.name.startswith(NOT_OURS))
        return replaced(current, {each.name: each.value for each in ours})

    def check(parameters: Sequence[Parameter]) -> SetParametersResult:
        try:
            changed(parameters)
        except InputError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def take(parameters: Sequence[Parameter]) -> None:
        nonlocal current
        current = changed(parameters)
        apply(current)

    node.add_on_set_parameters_callback(check)
    node.add_post_set_parameters_callback(take)


def check_sim_time(value: object) -> None:
    """Checks a value of use_sim_time, which rclpy itself reads.

    Raises:
        InputError: it is neither true nor false.
    """
    if not isinstance(value, bool):
        raise InputError(f'parameter use_sim_time takes bool, not {value!r}')


def override(node: Node, name: str, default: T) -> T:
    """The override of one parameter before it is declared; `default` if there is none."""
    return node.get_parameter(name).value if node.has_parameter(name) else default


def _declare(node: Node, name: str, value: Any, described: Described, read_only: bool) -> Any:
    descriptor = ParameterDescriptor(
        description=described.text,
        additional_constraints=described.range_text() if described.is_bounded else '',
        read_only=read_only,
        dynamic_typing=True,
    )
    if not node.has_parameter(name):
        return node.declare_parameter(name, value, descriptor).value
    node.set_descriptor(name, descriptor)
    return node.get_parameter(name).value
