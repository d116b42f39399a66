"""Refuses parameters that would have no effect in a run of the cell."""

from push_core.common import InputError, flatten
from push_mpc.settings import CONTROLLERS
from push_sim.node import NodeSettings

from push_bringup.setup.cell_parameters import NODES, CellParameters
from push_bringup.setup.request import Request


def check_effective(request: Request, parameters: CellParameters) -> None:
    """Checks what was set in whatever way.

    Args:
        request: what the user asked for.
        parameters: of the run, before a folder is named for it.

    Raises:
        InputError: names the parameter, and what to do instead.
    """
    if parameters.mpc.start_from == 'plan':
        _check_start(parameters.sim)
    _check_modes(request, parameters)
    if request.model and request.model != 'analytical':
        controller = parameters.mpc.controller
        if not CONTROLLERS[controller].trained_model:
            raise InputError(f'--model is not for --controller {controller}')
    for name, value in (
        ('folder', parameters.recorder.folder),
        ('facts_file', parameters.recorder.facts_file),
    ):
        if value:
            raise _useless(f'recorder.{name}', 'the run names it; use -o for another folder')
    for name in request.overrides:
        node, _, own = name.partition('.')
        _check_choice(own if node in NODES else name, parameters)


def _check_start(sim: NodeSettings) -> None:
    default = flatten(type(sim.start)())
    for name, (value, _) in flatten(sim.start).items():
        if value != default[name][0]:
            raise _useless(
                f'start.{name}',
                'the cell puts the object to the start of the track; use --start here, '
                'start_offset.* or --perturb',
            )


def _check_modes(request: Request, parameters: CellParameters) -> None:
    modes = {parameters.sim.mode, parameters.mpc.mode, parameters.gp.mode}
    if request.is_in_process and modes != {'lockstep'}:
        raise _useless('mode', 'with --mode inprocess there are no nodes')
    if len(modes) > 1:
        raise InputError(
            f'sim_node.mode is {parameters.sim.mode}, mpc_node.mode {parameters.mpc.mode} and '
            f'gp_server.mode {parameters.gp.mode}; they must be the same, set all with --mode'
        )
    if parameters.mpc.learn != parameters.gp.learn:
        raise InputError(
            'gp_server.learn and mpc_node.learn must be the same, set both with --learn'
        )
    if parameters.gp.lesson and not parameters.gp.learn:
        raise _useless('gp_server.lesson', 'nothing is learned; use --learn')


def _check_choice(name: str, parameters: CellParameters) -> None:
    """Refuses parameters of what was not chosen."""
    weights = (
        'weights' if CONTROLLERS[parameters.mpc.controller].trained_model else 'force_weights'
    )
    group = name.partition('.')[0]
    if group in ('weights', 'force_weights') and group != weights:
        raise _useless(name, f'controller {parameters.mpc.controller} has {weights}.*')
    kind = parameters.sim.perturbation.kind
    if group == 'perturbation' and kind == 'none' and name != 'perturbation.kind':
        raise _useless(name, 'there is no perturbation; use --perturb or perturbation.kind')


def _useless(name: str, instead: str) -> InputError:
    return InputError(f'parameter {name} would have no effect: {instead}')
