"""The parameters of all nodes for one run: the file, the command line, the overrides; checked."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import yaml
from ament_index_python.packages import get_package_share_directory
from push_bag.record import RecorderSettings
from push_core.common import InputError, flatten, replaced, unused_names
from push_gp.server import ServerSettings
from push_mpc.settings import MpcSettings, mpc_settings
from push_sim.node import NodeSettings, node_settings

from push_bringup.setup.default_model import model_for
from push_bringup.setup.parameter_file import Values, parsed_parameters, read_parameter_file
from push_bringup.setup.request import Request

PARAMETERS_FILE = 'params.yaml'
FACTS_FILE = 'facts.json'
PLAN_FILE = 'nominal_trajectory.csv'
DEFAULT_CONTROLLER = 'gp'
_FACTS = (
    *('track', 'speed', 'controller', 'preset', 'profile', 'perturbation.kind', 'laps', 'seed'),
    *('mode', 'model', 'learn', 'lesson', 'require_recorder'),
)
"""Parameters that have facts of their own, or that do not change a run."""
_MODEL = {'model', 'gp_server.model'}
NODES = ('sim_node', 'gp_server', 'mpc_node', 'recorder')


@dataclass(frozen=True)
class CellParameters:
    """The settings of every node, resolved."""

    sim: NodeSettings
    gp: ServerSettings
    mpc: MpcSettings
    recorder: RecorderSettings

    def by_node(self) -> dict[str, dict[str, Any]]:
        """Node name to parameters by dotted name."""
        settings = (self.sim, self.gp, self.mpc, self.recorder)
        return {
            node: {name: value for name, (value, _) in flatten(own).items()}
            for node, own in zip(NODES, settings, strict=True)
        }

    def changed(self) -> str:
        """What differs from the defaults of profiles and preset and has no fact of its own.

        What several nodes share counts once, without the name of a node.
        """
        defaults = node_defaults(self.sim.profile, self.mpc.profile, self.mpc.preset)
        nodes: dict[str, list[str]] = {}
        for node, values in self.by_node().items():
            for name, value in values.items():
                usual = value == flatten(defaults[node])[name][0]
                if not (
                    usual or name in _FACTS or name.startswith('realtime.') or node == 'recorder'
                ):
                    nodes.setdefault(f'{name}={value}', []).append(node)
        return ', '.join(
            text if len(having) > 1 else f'{having[0]}.{text}' for text, having in nodes.items()
        )

    def as_yaml(self) -> str:
        """A ROS parameter file that holds every value."""
        blocks = {
            f'/**/{node}': {'ros__parameters': values} for node, values in self.by_node().items()
        }
        return yaml.safe_dump(blocks, sort_keys=False)


def installed_config(name: str) -> Path:
    """A file of the cell's configuration folder, as installed."""
    return Path(get_package_share_directory('push_bringup')) / 'config' / name


def resolved(request: Request, defaults: Path) -> CellParameters:
    """The parameters of one run; without a folder for the recording, see `recorded_in`.

    Of what sets a parameter the latter counts: the defaults, the parameter file of the request,
    its options, its overrides.

    Args:
        request: what the user asked for.
        defaults: parameter file of the cell.

    Raises:
        InputError: a parameter is unknown, out of range or would have no effect.
    """
    values = read_parameter_file(defaults, _names())
    values['mpc_node']['controller'] = DEFAULT_CONTROLLER
    given = _given(request)
    for node, changes in (*given.items(), *_options(request).items()):
        values[node].update(changes)
    parameters = _checked(values, request.overrides)
    names_model = request.model or 'model' in given['gp_server'] or _MODEL & {*request.overrides}
    return parameters if names_model else _with_default_model(parameters)


def _given(request: Request) -> Values:
    """The values of the request's parameter file, without the places of another run's files."""
    if not request.params:
        return {node: {} for node in NODES}
    values = read_parameter_file(request.params, _names(), request.namespace)
    for name in ('folder', 'facts_file', 'attachments'):
        values['recorder'].pop(name, None)
    return values


def _options(request: Request) -> Values:
    """The values of the request's options that were given."""
    mode = 'lockstep' if request.mode == 'inprocess' else request.mode
    common = {'profile': request.profile, 'mode': mode}
    learn = {'learn': True} if request.learn else {}
    options: Values = {
        'sim_node': {**common, 'seed': request.seed, 'perturbation.kind': request.perturb},
        'gp_server': {**learn, 'mode': mode, 'model': request.model},
        'mpc_node': {
            **common,
            **learn,
            'track': request.track,
            'speed': request.speed,
            'laps': request.laps,
            'controller': request.controller,
            'preset': request.preset,
            'start_from': request.start,
        },
    }
    return {
        node: {name: value for name, value in own.items() if value is not None}
        for node, own in options.items()
    }


def _with_default_model(parameters: CellParameters) -> CellParameters:
    model = model_for(parameters.mpc.controller)
    return replace(parameters, gp=replace(parameters.gp, model=model))


def recorded_in(parameters: CellParameters, folder: Path, inputs: Path) -> CellParameters:
    """The parameters of a run that is recorded.

    Args:
        parameters: of the run.
        folder: of the run.
        inputs: folder with the files that the recorder keeps, see `write_inputs`.
    """
    attachments = [str(inputs / name) for name in (PARAMETERS_FILE, PLAN_FILE)]
    # files that the parameters name
    named = [Path(parameters.gp.model), Path(parameters.mpc.track), Path(parameters.gp.lesson)]
    attachments += [str(path) for path in named if path.suffix and path.is_file()]
    attachments += parameters.recorder.attachments.splitlines()
    recorder = replace(
        parameters.recorder,
        folder=str(folder),
        facts_file=str(inputs / FACTS_FILE),
        attachments='\n'.join(attachments),
    )
    return replace(parameters, recorder=recorder)


def recorded_parameters(text: str, overrides: Mapping[str, object]) -> CellParameters:
    """The parameters of a recorded run.

    Args:
        text: the YAML that `as_yaml` made.
        overrides: changed values, by NAME or NODE.NAME.

    Raises:
        InputError: the text is no parameter file, a parameter is unknown, or a value out of range.
    """
    values = parsed_parameters(text, 'the recorded parameters', _names())
    for node, defaults in _defaults(values).items():
        # older recordings name them; they had no effect then either
        for name in unused_names(defaults):
            values[node].pop(name, None)
    return _checked(values, overrides)


def _names() -> dict[str, Collection[str]]:
    return {node: flatten(defaults).keys() for node, defaults in node_defaults('irb120').items()}


def _checked(values: dict[str, dict[str, Any]], overrides: Mapping[str, object]) -> CellParameters:
    defaults = _defaults(values)
    for name, value in overrides.items():
        for node, key in _owners(defaults, name):
            values[node][key] = value
    changed = _defaults(values)
    settings = [replaced(changed[node], values[node], node) for node in NODES]
    return CellParameters(*settings)


def node_defaults(
    sim_profile: str, mpc_profile: str | None = None, preset: str = 'tuned'
) -> dict[str, Any]:
    """Each node's own defaults; controller and plant may be of different profiles."""
    return {
        'sim_node': node_settings(sim_profile),
        'gp_server': ServerSettings(),
        'mpc_node': mpc_settings(mpc_profile or sim_profile, preset),
        'recorder': RecorderSettings(),
    }


def _defaults(values: dict[str, dict[str, Any]]) -> dict[str, Any]:
    sim, mpc = (str(values[node].get('profile', 'irb120')) for node in ('sim_node', 'mpc_node'))
    return node_defaults(sim, mpc, str(values['mpc_node'].get('preset', 'tuned')))


def _owners(defaults: Mapping[str, Any], name: str) -> list[tuple[str, str]]:
    """Node and key of a parameter, for every node that has it or for the one that is named."""
    node, _, rest = name.partition('.')
    if node in NODES:
        return [(node, rest)]
    owners = [(node, name) for node in NODES if name in flatten(defaults[node])]
    if not owners:
        raise InputError(f'unknown parameter {name!r}; known: {_known(defaults)}')
    return owners


def _known(defaults: Mapping[str, Any]) -> str:
    return ', '.join(sorted({name for node in NODES for name in flatten(defaults[node])}))
