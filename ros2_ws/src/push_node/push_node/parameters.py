"""Parameters of a node, declared from its settings class."""

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from push_core.common import Described, InputError, flatten, reject_unknown, replaced
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

T = TypeVar('T')
NOT_OURS = ('use_sim_time', 'qos_overrides.', 'start_type_description_service')
"""Beginnings of the names of parameters that rclpy declares itself."""


def declared(node: Node, defaults: T, changeable: Callable[[str], bool] = lambda _: False) -> T:
    """Declares every value of a settings object as a parameter; returns the settings in effect.

    Args:
        node: owns the parameters; made with `automatically_declare_parameters_from_overrides`, or
            else unknown overrides pass unnoticed.
        defaults: settings made with `push_core.common.settings`.
        changeable: whether a parameter may change while the node runs; see `on_change`.

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
        name: _declare(node, name, value, described, changeable(name))
        for name, (value, described) in flatten(defaults).items()
    }
    node.add_on_set_parameters_callback(lambda parameters: _fixed(parameters, changeable))
    return replaced(defaults, changes)


def on_change(
    node: Node,
    settings: T,
    apply: Callable[[T], None],
    check: Callable[[T], None] = lambda _: None,
) -> None:
    """Checks changes of parameters together, and applies them between two callbacks.

    Args:
        node: owns the parameters.
        settings: in effect.
        apply: takes the changed settings; must not wait.
        check: raises InputError if the changed settings do not fit what the node does.
    """
    current = settings

    def changed(parameters: Sequence[Parameter]) -> T:
        ours = (each for each in parameters if not each.name.startswith(NOT_OURS))
        return replaced(current, {each.name: each.value for each in ours})

    def checked(parameters: Sequence[Parameter]) -> SetParametersResult:
        try:
            check(changed(parameters))
        except InputError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def take(parameters: Sequence[Parameter]) -> None:
        nonlocal current
        current = changed(parameters)
        apply(current)

    node.add_on_set_parameters_callback(checked)
    node.add_post_set_parameters_callback(take)


def _fixed(
    parameters: Sequence[Parameter], changeable: Callable[[str], bool]
) -> SetParametersResult:
    """Refuses changes of what the node was made of."""
    names = [each.name for each in parameters]
    # rclpy declares parameters of its own, and refuses to change most of them
    ours = (name for name in names if name == 'use_sim_time' or not name.startswith(NOT_OURS))
    for name in (name for name in ours if not changeable(name)):
        instead = 'start it with mode:=lockstep' if name == 'use_sim_time' else 'start it again'
        reason = f'parameter {name} is read-only while the node runs; {instead} to change it'
        return SetParametersResult(successful=False, reason=reason)
    return SetParametersResult(successful=True)


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


def _declare(node: Node, name: str, value: Any, described: Described, changeable: bool) -> Any:
    constraints = [described.range_text()] if described.is_bounded else []
    constraints += [] if changeable else ['read-only while the node runs']
    # rclpy would refuse a change of what is `read_only` without saying what to do
    descriptor = ParameterDescriptor(
        description=described.text,
        additional_constraints='; '.join(constraints),
        dynamic_typing=True,
    )
    if not node.has_parameter(name):
        return node.declare_parameter(name, value, descriptor).value
    node.set_descriptor(name, descriptor)
    return node.get_parameter(name).value
