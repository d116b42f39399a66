"""Fetches what a recomputation needs from the running nodes: parameters, model file, track file.

`cell` and the launch file attach these themselves. This is for nodes that were started by hand.
"""

import platform
from collections.abc import Mapping
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

from push_msgs.srv import GetModel
from push_node import interface
from push_node.ask import RepeatedRequest
from push_node.endpoints import parameter_clients
from push_node.parameters import NOT_OURS
from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python

from push_bag.file import FACTS_RECORD, BagWriter, to_yaml

PARAMS_FILE = 'params.yaml'
NODES = ('sim_node', 'gp_server', 'mpc_node')
FACTS = {
    'track': ('mpc_node', 'track'),
    'speed': ('mpc_node', 'speed'),
    'controller': ('mpc_node', 'controller'),
    'profile': ('mpc_node', 'profile'),
    'laps': ('mpc_node', 'laps'),
    'mode': ('mpc_node', 'mode'),
    'perturb': ('sim_node', 'perturbation.kind'),
    'seed': ('sim_node', 'seed'),
}
"""Facts of a run, with the node and parameter that state each."""


class CellInputs:
    """Asks the nodes in the recorder's namespace, and attaches their responses to the bag."""

    def __init__(self, node: Node, writer: BagWriter, own: Mapping[str, Any]) -> None:
        """Sends nothing yet.

        Args:
            node: the recorder.
            writer: of its bag.
            own: parameters of the recorder, which the bag lists as well.
        """
        self._writer = writer
        self._own = {'recorder': {'ros__parameters': dict(own)}}
        self._parameters = {name: _NodeParameters(node, name) for name in NODES}
        self._model = RepeatedRequest(interface.GET_MODEL.client(node), GetModel.Request())
        self._attached: set[str] = set()

    @property
    def awaited(self) -> set[str]:
        """Nodes that are there and have not yet stated their parameters.

        A run that begins before they have is not reproducible: what changes meanwhile would be
        taken for the values at its start.
        """
        there = {name for name, each in self._parameters.items() if each.is_there}
        return there - self._attached

    def poll(self) -> None:
        """Attaches what has come since the last call.

        Raises:
            RunError: the bag cannot be written.
        """
        known = {name: each.values() for name, each in self._parameters.items()}
        values = {name: each for name, each in known.items() if each is not None}
        if not values.keys() <= self._attached:
            self._attached |= values.keys()
            self._attach_parameters(values)
        model = None if 'model' in self._attached else self._model.response()
        if model is not None:
            self._attached.add('model')
            if model.success and model.name:
                self._writer.attach(model.name, bytes(model.content))

    def _attach_parameters(self, values: Mapping[str, Mapping[str, Any]]) -> None:
        """Attaches all that is known; of several attachments of a name the last one counts."""
        blocks = {name: {'ros__parameters': dict(each)} for name, each in values.items()}
        named = {f'/**/{name}': block for name, block in (blocks | self._own).items()}
        self._writer.attach(PARAMS_FILE, to_yaml(named).encode())
        self._writer.add_facts(FACTS_RECORD, _facts(values))
        track = Path(str(values.get('mpc_node', {}).get('track', '')))
        if track.suffix and track.is_file() and 'track' not in self._attached:
            self._attached.add('track')
            self._writer.attach(track.name, track.read_bytes())


class _NodeParameters:
    """The parameters of one node, as its parameter services state them."""

    def __init__(self, node: Node, name: str) -> None:
        full_name = f'{node.get_namespace().rstrip("/")}/{name}'
        listing, self._get = parameter_clients(node, full_name)
        self._listing = listing
        self._listed = RepeatedRequest(listing, ListParameters.Request())
        self._names: list[str] = []
        self._answered: RepeatedRequest | None = None

    @property
    def is_there(self) -> bool:
        """Whether the node can be asked."""
        return bool(self._listing.service_is_ready())

    def values(self) -> dict[str, Any] | None:
        """Values by name; None until they have come."""
        if self._answered is None:
            listed = self._listed.response()
            if listed is None:
                return None
            self._names = [each for each in listed.result.names if not each.startswith(NOT_OURS)]
            request = GetParameters.Request(names=self._names)
            self._answered = RepeatedRequest(self._get, request)
        response = self._answered.response()
        if response is None:
            return None
        return {
            name: _plain(parameter_value_to_python(value))
            for name, value in zip(self._names, response.values, strict=True)
        }


def _plain(value: Any) -> Any:
    """A value that YAML can hold."""
    return value if isinstance(value, bool | int | float | str) else list(value)


def _facts(values: Mapping[str, Mapping[str, Any]]) -> dict[str, str]:
    stated = {
        fact: str(values[node][parameter])
        for fact, (node, parameter) in FACTS.items()
        if parameter in values.get(node, {})
    }
    now = datetime.now(timezone.utc).isoformat(timespec='seconds')
    return {**stated, 'started': now, 'machine': platform.platform()}
