"""The nodes that `ros2 launch push_bringup cell.launch.py` starts; needs no launch itself."""

import argparse
import atexit
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from push_core.common import InputError
from push_mpc.plan import planned
from push_node.interface import CLOCK

from push_bringup.commands.cell_options import requested
from push_bringup.commands.launch_arguments import DEFAULTS, number
from push_bringup.setup import (
    PARAMETERS_FILE,
    CellParameters,
    Request,
    check_effective,
    installed_config,
    new_run_folder,
    recorded_in,
    resolved,
    write_inputs,
)

NODES = {'sim_node': 'push_sim', 'gp_server': 'push_gp', 'mpc_node': 'push_mpc'}
"""Executables that always run, with their packages."""


@dataclass(frozen=True)
class LaunchedNode:
    """One executable to start.

    Attributes:
        package: that holds the executable.
        executable: its name.
        arguments: of its command line, before those of ROS.
        params: parameter file, or None.
        is_vital: whether the cell ends when it ends, even with status 0.
    """

    package: str
    executable: str
    arguments: tuple[str, ...] = ()
    params: Path | None = None
    is_vital: bool = True


@dataclass(frozen=True)
class LaunchedCell:
    """What is started.

    Attributes:
        nodes: executables, in order.
        namespace: of all of them; '' for none.
        folder: of the bag, None if none is recorded.
    """

    nodes: tuple[LaunchedNode, ...]
    namespace: str
    folder: Path | None

    @property
    def remappings(self) -> list[tuple[str, str]]:
        """Gives each namespace a simulated time of its own."""
        return [(CLOCK.name, CLOCK.short_name)] if self.namespace else []


def launched_cell(values: Mapping[str, str]) -> LaunchedCell:
    """Checks the arguments and writes the parameter file of the nodes.

    Args:
        values: of all arguments, by name.

    Raises:
        InputError: an argument or a parameter is out of range.
    """
    recorded = values['record'] == 'true'
    request = _request(values, recorded)
    inputs = Path(tempfile.mkdtemp(prefix='push_cell_'))
    atexit.register(shutil.rmtree, inputs, ignore_errors=True)
    parameters = resolved(request, installed_config('cell.yaml'))
    check_effective(request, parameters)
    folder = _folder(values['folder'], request.output, parameters)
    parameters = recorded_in(parameters, folder, inputs)
    write_inputs(request, parameters, planned(parameters.mpc), inputs)
    nodes = _nodes(values, recorded, inputs / PARAMETERS_FILE)
    return LaunchedCell(nodes, request.namespace, folder if recorded else None)


def _request(values: Mapping[str, str], recorded: bool) -> Request:
    # a default of the launch file must not override the parameter file
    chosen = {name: value for name, value in values.items() if value != DEFAULTS[name]}
    options = argparse.Namespace(
        track=chosen.get('track'),
        speed=number(chosen, 'speed', float),
        controller=chosen.get('controller'),
        model=Path(values['model']) if values['model'] else None,
        profile=chosen.get('profile'),
        preset=chosen.get('preset'),
        perturb=None,
        start=chosen.get('start'),
        mode=chosen.get('mode'),
        laps=number(chosen, 'laps', int),
        learn=values['learn'] == 'true',
        learn_from=None,
        seed=number(chosen, 'seed', int),
        namespace=values['namespace'],
        params=Path(values['params_file']) if values['params_file'] else None,
        param=[] if recorded else ['mpc_node.require_recorder:=false'],
        output=Path('runs'),
        watch=False,
    )
    return requested(options)


def _folder(given: str, output: Path, parameters: CellParameters) -> Path:
    """The named folder, or one that no other launch takes, even in the same second."""
    if given:
        if Path(given).exists():
            raise InputError(f'folder {given} exists; name a new one, or none')
        return Path(given)
    now = datetime.now().astimezone()
    folder = new_run_folder(output, parameters.mpc, now)
    return folder.with_name(f'{folder.name}_{now:%f}')


def _nodes(values: Mapping[str, str], recorded: bool, params: Path) -> tuple[LaunchedNode, ...]:
    nodes = [LaunchedNode(package, name, params=params) for name, package in NODES.items()]
    if recorded:
        nodes.append(LaunchedNode('push_bag', 'recorder', params=params))
    if values['rviz'] == 'true':
        layout = str(installed_config('cell.rviz'))
        nodes.append(LaunchedNode('push_bag', 'markers', is_vital=False))
        nodes.append(LaunchedNode('rviz2', 'rviz2', ('-d', layout), is_vital=False))
    if values['autostart'] == 'true':
        nodes.append(LaunchedNode('push_bringup', 'start', is_vital=False))
    return tuple(nodes)
