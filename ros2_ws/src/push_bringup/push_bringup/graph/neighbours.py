"""Nodes that other programs run where a cell is to run."""

import time

from push_core.common import RunError
from push_node.graph import SINGLE_SOURCE, publisher_names, second_source
from rclpy.node import Node

from push_bringup.graph.processes import MODULES

DISCOVERY_TIME = 0.6  # [s] for nodes that run already to answer a new one
_ADVICE = 'stop them, or give this cell a --namespace or a ROS_DOMAIN_ID of its own'


def check_alone(node: Node) -> None:
    """Checks that no cell runs in the namespace of a node; before its own nodes start.

    Raises:
        RunError: names the nodes of the other one.
    """
    time.sleep(DISCOVERY_TIME)
    others = _other_nodes(node)
    if others:
        raise RunError(f'other nodes run here: {", ".join(others)}; {_ADVICE}')


def check_single(node: Node) -> None:
    """Checks that poses and commands have one source each; when the nodes of the cell run.

    Raises:
        RunError: names the topic and the nodes.
    """
    conflict = rivals(node)
    if conflict:
        raise RunError(conflict)


def rivals(node: Node) -> str:
    """Second sources of poses or commands, and what to do; empty without one."""
    conflict = second_source(node)
    return f'{conflict}; {_ADVICE}' if conflict else ''


def _other_nodes(node: Node) -> list[str]:
    own_namespace = node.get_namespace()
    named = {
        f'{namespace.rstrip("/")}/{name}'
        for name, namespace in node.get_node_names_and_namespaces()
        if namespace == own_namespace and name in MODULES
    }
    sources = {name for topic in SINGLE_SOURCE for name in publisher_names(node, topic.name)}
    return sorted(named | sources)
