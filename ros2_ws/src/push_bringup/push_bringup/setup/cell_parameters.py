"""The parameters of all nodes for one run: the file, the command line, the overrides; checked."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from ament_index_python.packages import get_package_share_directory
from push_bag.record import RecorderSettings
from push_core.common import InputError, flatten, replaced, unused_names
from push_gp.server import ServerSettings
from push_mpc.settings import MpcSettings, mpc_settings
from push_sim.node import NodeSettings, node_settings

from push_bringup.setup.request import Request

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

    def as_yaml(self) -> str:
        """A ROS parameter file that holds every value."""
        blocks = {
            f'/**/{node}': {'ros__parameters': values} for node, values in self.by_node().items()
        }
        return yaml.safe_dump(blocks, sort_keys=False)


def installed_config(name: str) -> Path:
    """A file of the cell's configuration folder, as installed."""
    return Path(get_package_share_directory('push_bringup')) / 'config' / name


def resolved(request: Request, defaults: Path, folder: Path, inputs: Path) -> CellParameters:
    """The parameters of one run.

    Args:
        request: what the user asked for.
        defaults: parameter file of the cell.
        folder: of the run, for the recorder.
        inputs: folder with the files that the recorder keeps.

    Raises:
        InputError: an unknown parameter, or a value out of range.
    """
    values = _from_file(defaults)
    for node, own in _from_file(request.params).items() if request.params else ():
        values[node].update(own)
    for node, changes in _from_request(request, folder, inputs).items():
        values[node].update(changes)
    return _checked(values, request.overrides)


def recorded_parameters(text: str, overrides: Mapping[str, object]) -> CellParameters:
    """The parameters of a recorded run.

    Args:
        text: the YAML that `as_yaml` made.
        overrides: changed values, by NAME or NODE.NAME.

    Raises:
        InputError: the text is no parameter file, a parameter is unknown, or a value out of range.
    """
    values = _from_text(text, 'the recorded parameters')
    for node, defaults in _defaults(values).items():
        # older recordings name them; they had no effect then either
        for name in unused_names(defaults):
            values[node].pop(name, None)
    return _checked(values, overrides)


def _from_file(path: Path) -> dict[str, dict[str, Any]]:
    try:
        return _from_text(path.read_text(encoding='utf-8'), str(path))
    except OSError as error:
        raise InputError(f'cannot read {path}: {error.strerror}') from error
    except UnicodeDecodeError as error:
        raise InputError(f'{path}: is not a text file') from error


def _from_text(text: str, source: str) -> dict[str, dict[str, Any]]:
    try:
        blocks = yaml.safe_load(text)
        unknown = sorted(set(blocks) - {f'/**/{node}' for node in NODES})
        values = {node: _block(blocks, node) for node in NODES}
    except (yaml.YAMLError, KeyError, TypeError, ValueError, AttributeError) as error:
        raise InputError(
            f'{source}: is not a parameter file with blocks such as '
            f'/**/{NODES[0]} with ros__parameters'
        ) from error
    if unknown:
        known = ', '.join(f'/**/{node}' for node in NODES)
        raise InputError(f'{source}: unknown block {unknown[0]!r}; known: {known}')
    return values


def _block(blocks: Mapping[str, Any], node: str) -> dict[str, Any]:
    block = blocks.get(f'/**/{node}', {'ros__parameters': {}})
    return dict(block['ros__parameters'])


def _from_request(request: Request, folder: Path, inputs: Path) -> dict[str, dict[str, Any]]:
    mode = 'lockstep' if request.mode == 'inprocess' else request.mode
    common = {'profile': request.profile, 'mode': mode}
    attachments = [inputs / 'params.yaml', inputs / 'nominal_trajectory.csv']
    # files that the parameters name
    named = (Path(request.model), Path(request.track))
    attachments += [path for path in named if path.suffix and path.is_file()]
    return {
        'sim_node': {**common, 'seed': request.seed, 'perturbation.kind': request.perturb},
        'gp_server': {'model': request.model},
        'mpc_node': {
            **common,
            'track': request.track,
            'speed': request.speed,
            'laps': request.laps,
            'controller': request.controller,
            'preset': request.preset,
        },
        'recorder': {
            'folder': str(folder),
            'facts_file': str(inputs / 'facts.json'),
            'attachments': '\n'.join(str(path) for path in attachments),
        },
    }


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
