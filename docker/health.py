"""Exits with 0 as soon as a node says how it is on /diagnostics, with 1 if it does not in time."""

import sys
import time

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from push_node.diagnostics import status_name
from push_node.spin import Spinner
from rclpy.node import Node

PATIENCE = 5.0  # [s]; nodes report once a second


def reports(node_name: str, patience: float = PATIENCE) -> bool:
    """Whether a node (fully qualified name) publishes a status within a time [s]."""
    heard: list[str] = []
    rclpy.init(args=[])
    node = Node('health')
    node.create_subscription(
        DiagnosticArray,
        '/diagnostics',
        lambda message: heard.extend(status.name for status in message.status),
        10,
    )
    spinner = Spinner(node)
    deadline = time.monotonic() + patience
    prefix = status_name(node_name, '')
    while not any(name.startswith(prefix) for name in heard) and time.monotonic() < deadline:
        spinner.once()
    node.destroy_node()
    rclpy.try_shutdown()
    return any(name.startswith(prefix) for name in heard)


if __name__ == '__main__':
    sys.exit(0 if reports(sys.argv[1]) else 1)
