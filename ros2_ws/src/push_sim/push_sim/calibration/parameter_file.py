"""Fitted parameters as a ROS parameter file that plant and controller read."""

from collections.abc import Sequence

from push_sim.calibration.fit import Fitted

_NODES = {'sim_node': ('world', 'actuator'), 'mpc_node': ('actuator',)}
"""Which parts of the plant each node knows; the controller predicts with the same actuator."""


def parameter_file(parameters: Sequence[Fitted], measured: str) -> str:
    """The file as text.

    Args:
        parameters: what was fitted.
        measured: SHA-256 of the measurements.
    """
    head = (
        '# Made by `ros2 run push_sim calibrate`; `cell --params FILE` uses it.\n'
        '# After each value: its standard deviation.\n'
        f'# measurements: SHA-256 {measured}\n'
    )
    return head + ''.join(_block(node, parts, parameters) for node, parts in _NODES.items())


def _block(node: str, parts: Sequence[str], parameters: Sequence[Fitted]) -> str:
    own = [each for each in parameters if each.name.split('.')[0] in parts]
    if not own:
        return ''
    lines = ''.join(f'    {_line(each)}\n' for each in own)
    return f'/**/{node}:\n  ros__parameters:\n{lines}'


def _line(fitted: Fitted) -> str:
    value = f'{fitted.name}: {fitted.value:.6f}'
    return f'{value:34}# +- {fitted.deviation:.2g} {fitted.unit}'.rstrip()
