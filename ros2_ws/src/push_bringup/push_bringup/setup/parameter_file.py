"""ROS parameter files, in every form that ROS itself takes.

A block `ros__parameters` is for the nodes whose full name the keys above it spell: `/**/sim_node`,
`/**`, `/cell/sim_node`, or one key below another. `*` stands for one part of a name, `**` for any
number of parts. Parameters may be nested mappings. Of several values of one parameter the last one
counts.
"""

import re
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

import yaml
from push_core.common import InputError
from push_node.parameter_yaml import load_yaml

PARAMETERS = 'ros__parameters'
_OF_RCLPY = ('qos_overrides.', 'start_type_description_service', 'use_sim_time')
"""Begin the names of what rclpy itself adds to a dump."""

Values = dict[str, dict[str, Any]]
"""Node to values by dotted name."""


def read_parameter_file(
    path: Path, known: Mapping[str, Collection[str]], namespace: str = ''
) -> Values:
    """Reads a file; see `parsed_parameters`.

    Raises:
        InputError: it cannot be read, or is no parameter file.
    """
    try:
        text = path.read_text(encoding='utf-8-sig')
    except OSError as error:
        raise InputError(f'cannot read {path}: {error.strerror}') from error
    except UnicodeDecodeError as error:
        raise InputError(f'{path}: is not a text file') from error
    return parsed_parameters(text, str(path), known, namespace)


def parsed_parameters(
    text: str, source: str, known: Mapping[str, Collection[str]], namespace: str = ''
) -> Values:
    """The values that a text has for each node.

    Args:
        text: of the file.
        source: what messages call it.
        known: node to its parameters; a block for all nodes gives each node those that it has.
        namespace: of the nodes, without slashes around it.

    Raises:
        InputError: the text is no parameter file, or a block is for none of the nodes.
    """
    values: Values = {node: {} for node in known}
    blocks = list(_blocks(_tree(text, source, known), ''))
    for name, block in blocks:
        nodes = [node for node in known if _covers(name, f'{namespace}/{node}')]
        if not nodes and name.rpartition('/')[2] not in known:
            raise InputError(f'{source}: unknown block {name!r}; known: {_examples(known)}')
        for key, value in _flat(block):
            for node in _owners(key, value, nodes, known, f'{source}, {name}'):
                values[node][key] = value
    if any(block for _, block in blocks) and not any(values.values()):
        raise InputError(f'{source}: no parameter is for a node of namespace /{namespace}')
    return values


def _tree(text: str, source: str, known: Collection[str]) -> Mapping[str, Any]:
    """The text as nested mappings, with blocks at the ends.

    Raises:
        InputError: it is something else.
    """
    try:
        tree = load_yaml(text)
    except (yaml.YAMLError, ValueError):
        tree = None
    if not _is_tree(tree):
        raise InputError(
            f'{source}: is not a parameter file with blocks such as '
            f'{_examples(list(known)[:1])} with {PARAMETERS}'
        )
    return dict(tree)


def _is_tree(tree: Any) -> bool:
    """Whether every branch ends in a block."""
    return (
        isinstance(tree, Mapping)
        and bool(tree)
        and all(
            block is None or isinstance(block, Mapping) if key == PARAMETERS else _is_tree(block)
            for key, block in tree.items()
        )
    )


def _blocks(tree: Mapping[str, Any], above: str) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Name and parameters of each block, in the order of the file."""
    for key, below in tree.items():
        if key == PARAMETERS:
            yield above or '/**', below or {}
        else:
            # as relative to any namespace, where no slash says otherwise
            begin = above if above or str(key).startswith('/') else '/**'
            yield from _blocks(below, f'{begin}/{str(key).strip("/")}')


def _covers(pattern: str, name: str) -> bool:
    """Whether a name pattern is for a node, both from the root."""
    wild = {'*': '/[^/]+', '**': '(/[^/]+)*'}
    parts = (wild.get(part, '/' + re.escape(part)) for part in pattern.strip('/').split('/'))
    return re.fullmatch(''.join(parts), f'/{name.strip("/")}') is not None


def _flat(block: Mapping[str, Any], prefix: str = '') -> Iterator[tuple[str, Any]]:
    """Values by dotted name."""
    for key, value in block.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f'{prefix}{key}.')
        else:
            yield f'{prefix}{key}', value


def _owners(
    key: str, value: Any, nodes: Collection[str], known: Mapping[str, Collection[str]], place: str
) -> Collection[str]:
    """The nodes that take a parameter of a block for these nodes."""
    if key == 'use_sim_time' and value is True:
        raise InputError(f'{place}: use_sim_time has no effect; use --mode lockstep')
    if key.startswith(_OF_RCLPY):
        return ()
    if len(nodes) < 2:
        return nodes
    owners = [node for node in nodes if key in known[node]]
    if not owners:
        raise InputError(f'{place}: unknown parameter {key!r} of all nodes')
    return owners


def _examples(nodes: Collection[str]) -> str:
    return ', '.join(f'/**/{node}' for node in nodes)
