"""Nodes as processes of their own, and one client in this process."""

import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import rclpy
from node_tests import kill_all
from push_node.spin import Spinner
from rclpy.context import Context
from rclpy.node import Node

PATIENCE = 60.0  # [s]; nothing but a hang takes that long

Process = subprocess.Popen[str]
NodeMaker = Callable[..., Node]


@pytest.fixture
def started() -> Iterator[Callable[..., Process]]:
    """Starts a program that holds a node, with ROS arguments."""
    processes: list[Process] = []

    def start(program: str, *arguments: str) -> Process:
        process = subprocess.Popen(
            [sys.executable, '-c', program, '--ros-args', *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        processes.append(process)
        return process

    yield start
    kill_all(processes)


@pytest.fixture(scope='module')
def context() -> Iterator[Context]:
    rclpy.init()
    yield rclpy.get_default_context()
    rclpy.try_shutdown()


@pytest.fixture
def made_node(context: Context) -> Iterator[NodeMaker]:
    """Makes nodes in this process, with parameter overrides as a command line gives them."""
    nodes: list[Node] = []

    def make(
        name: str = 'tested', *overrides: str, namespace: str = '', file: Path | None = None
    ) -> Node:
        arguments = [part for override in overrides for part in ('-p', override)]
        arguments += ['--params-file', str(file)] if file else []
        node = Node(
            name,
            cli_args=['--ros-args', *arguments],
            namespace=namespace,
            automatically_declare_parameters_from_overrides=True,
        )
        nodes.append(node)
        return node

    yield make
    for node in nodes:
        node.destroy_node()


@pytest.fixture
def spun_until() -> Callable[[Node, Callable[[], bool]], None]:
    """Spins a node until a condition holds."""

    def spin(node: Node, finished: Callable[[], bool]) -> None:
        spinner, end = Spinner(node), time.monotonic() + PATIENCE
        try:
            while not finished():
                assert time.monotonic() < end, 'it did not happen'
                spinner.once()
        finally:
            spinner.close()

    return spin
