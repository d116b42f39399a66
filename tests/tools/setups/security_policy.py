r"""Writes the policy of DDS security for the nodes of a cell: what each of them uses, and no more.

    python tests/tools/setups/security_policy.py > \
        ros2_ws/src/push_bringup/config/security_policy.xml

It runs a cell and asks the graph; the recorder reads every topic of the interface, now or later.
docs/security.md says how it is used; tests/test_security.py compares it with the interface.
"""

import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Mapping
from xml.sax.saxutils import escape

import rclpy
from push_node.interface import TOPICS
from push_node.spin import Spinner
from push_node.start_ros import init_ros
from rclpy.node import Node

NODES = ('cell', 'gp_server', 'mpc_node', 'recorder', 'sim_node')
KINDS = (
    ('services', 'reply'),
    ('services', 'request'),
    ('topics', 'publish'),
    ('topics', 'subscribe'),
)
Endpoints = dict[str, dict[tuple[str, str], set[str]]]
"""Node, to kind, to the full names that it uses."""


def used(environment: Mapping[str, str]) -> Endpoints:
    """Everything that the nodes of a cell use during a lap in real time."""
    with tempfile.TemporaryDirectory() as folder:
        command = [
            *(sys.executable, '-m', 'push_bringup.commands.cell', '--controller', 'analytical'),
            *('--track', 'line', '--speed', '0.1', '--learn', '-o', folder),
            *('-p', 'mpc_node.pose_loss:=10.0'),
        ]
        with subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL) as cell:
            try:
                found = _collected(cell)
            finally:
                cell.terminate()
    found['recorder']['topics', 'subscribe'] |= {topic.absolute_name for topic in TOPICS}
    return found


def _collected(cell: 'subprocess.Popen[bytes]') -> Endpoints:
    init_ros()
    node, found = Node('security_policy'), defaultdict(lambda: defaultdict(set))
    spinner = Spinner(node)
    while cell.poll() is None:
        spinner.once()
        for name, namespace in node.get_node_names_and_namespaces():
            if name in NODES:
                _add(node, name, namespace, found[name])
    node.destroy_node()
    rclpy.try_shutdown()
    return found


def _add(node: Node, name: str, namespace: str, kinds: dict[tuple[str, str], set[str]]) -> None:
    try:
        answers = (
            node.get_service_names_and_types_by_node(name, namespace),
            node.get_client_names_and_types_by_node(name, namespace),
            node.get_publisher_names_and_types_by_node(name, namespace),
            node.get_subscriber_names_and_types_by_node(name, namespace),
        )
    except rclpy._rclpy_pybind11.NodeNameNonExistentError:
        return
    for kind, answer in zip(KINDS, answers, strict=True):
        kinds[kind] |= {each for each, _ in answer}


def policy(endpoints: Endpoints) -> str:
    """The policy as sros2 reads it, one enclave for each node."""
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', '<policy version="0.2.0">', '  <enclaves>']
    for name in sorted(endpoints):
        lines += [
            f'    <enclave path="/push_cell/{name}">',
            '      <profiles>',
            f'        <profile ns="/" node="{name}">',
        ]
        for group, right in KINDS:
            names = sorted(endpoints[name][group, right])
            if names:
                lines.append(f'          <{group} {right}="ALLOW">')
                lines += [f'            <{group[:-1]}>{escape(n)}</{group[:-1]}>' for n in names]
                lines.append(f'          </{group}>')
        lines += ['        </profile>', '      </profiles>', '    </enclave>']
    return '\n'.join([*lines, '  </enclaves>', '</policy>', ''])


if __name__ == '__main__':
    sys.stdout.write(policy(used(os.environ)))
