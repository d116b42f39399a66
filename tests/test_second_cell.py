"""A cell beside nodes that somebody started by hand."""

import subprocess
import sys
from collections.abc import Iterator

import pytest
from cell_command import HANG, Ended

LINE = ('--track', 'line', '--controller', 'analytical', '--mode', 'lockstep')


@pytest.fixture
def plant_by_hand(environment: dict[str, str]) -> Iterator[None]:
    node = subprocess.Popen(
        [sys.executable, '-m', 'push_sim.node.sim_node'],
        env=environment,
        stderr=subprocess.PIPE,
        text=True,
    )
    # its first line comes when it runs
    assert node.stderr.readline()
    yield
    node.terminate()
    node.communicate(timeout=HANG)


def test_a_cell_refuses_to_start_beside_nodes_started_by_hand(run_cell, plant_by_hand) -> None:
    refused: Ended = run_cell(*LINE)
    assert refused.status == 1
    line = refused.err.splitlines()[-1]
    # on a busy machine they are found only when those of the cell run, some before their names
    assert 'other nodes run here: /sim_node;' in line or 'has 2 publishers: ' in line
    assert 'stop them, or give this cell a --namespace' in line


def test_a_namespace_of_its_own_lets_it_run(run_cell, plant_by_hand) -> None:
    assert run_cell(*LINE, '--namespace', 'left').status == 0
