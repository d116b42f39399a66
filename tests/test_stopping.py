"""Stops: on request, and when the controller dies.

How long they take is what `bench stopping` measures; here the nodes have to end by themselves.
"""

import contextlib
import json
import os
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from cell_command import HANG
from push_bag.run.run_reader import read_run
from push_bag.run.series import Stamped

AT_REST = 1e-3  # [m/s]


def nodes_of(cell: 'subprocess.Popen[str]') -> dict[str, int]:
    """The cell's child processes: module to process id."""
    rows = {process: arguments_of(process) for process in children_of(cell.pid)}
    return {row[row.index('-m') + 1]: process for process, row in rows.items() if '-m' in row}


def children_of(process: int) -> list[int]:
    """From /proc, so that no `ps` is needed; the fields before the parent end with a bracket."""
    children = []
    for folder in Path('/proc').glob('[0-9]*'):
        with contextlib.suppress(OSError):
            _, _, fields = (folder / 'stat').read_text().rpartition(')')
            if int(fields.split()[1]) == process:
                children.append(int(folder.name))
    return children


def arguments_of(process: int) -> list[str]:
    return Path(f'/proc/{process}/cmdline').read_text().split('\0')


def is_alive(process: int) -> bool:
    return Path(f'/proc/{process}').exists()


def tip_speed(tip: Stamped) -> np.ndarray:
    """Speeds (n,) [m/s] between the recorded poses."""
    step = np.diff(tip.stamp) * 1e-9
    return np.asarray(np.hypot(*np.diff(tip.values, axis=0).T) / step)


def wait_for_the_end(nodes: dict[str, int]) -> None:
    end = time.monotonic() + HANG
    while any(is_alive(node) for node in nodes.values()):
        assert time.monotonic() < end, nodes
        time.sleep(0.01)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_after_a_signal_the_nodes_end_by_themselves_and_the_bag_is_finished(
    pushing_cell: 'subprocess.Popen[str]', number: signal.Signals, tmp_path: Path
) -> None:
    nodes = nodes_of(pushing_cell)
    assert set(nodes) == {
        'push_sim.node.sim_node',
        'push_gp.server.gp_server',
        'push_mpc.node.mpc_node',
        'push_bag.record.recorder',
    }
    pushing_cell.send_signal(number)
    _, err = pushing_cell.communicate(timeout=HANG)
    assert pushing_cell.returncode == 130
    assert err.splitlines()[-1] == 'cell: interrupted'
    assert 'was killed' not in err
    assert not any(is_alive(node) for node in nodes.values())
    (folder,) = (tmp_path / 'runs').iterdir()
    assert (folder / 'metadata.yaml').exists()
    # the controller ended first, and its last command rests in the bag
    assert not read_run(folder).commands.values[-1].any()


def test_a_killed_controller_leaves_the_tip_at_rest_and_the_cell_says_why(
    pushing_cell: 'subprocess.Popen[str]', tmp_path: Path
) -> None:
    os.kill(nodes_of(pushing_cell)['push_mpc.node.mpc_node'], signal.SIGKILL)
    out, err = pushing_cell.communicate(timeout=HANG)
    assert pushing_cell.returncode == 1
    assert 'mpc_node' in err.splitlines()[-1]
    assert 'signal 9' in err.splitlines()[-1]
    folder = Path(out.splitlines()[-1])
    assert folder.parent == tmp_path / 'runs'
    score = json.loads((folder / 'score.json').read_text())
    assert not score['completed']
    assert 'signal 9' in score['stop_reason']
    speed = tip_speed(read_run(folder).pusher)
    assert speed.max() > 0.03
    assert speed[-1] < AT_REST


def test_a_killed_cell_leaves_no_nodes_behind(pushing_cell: 'subprocess.Popen[str]') -> None:
    nodes = nodes_of(pushing_cell)
    pushing_cell.send_signal(signal.SIGKILL)
    wait_for_the_end(nodes)
