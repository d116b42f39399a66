"""Stops: on request, and when the controller dies."""

import json
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from push_bag.run_reader import read_run

AT_REST = 1e-3  # [m/s]
REST_WITHIN = 0.25  # [s] of simulated time


def nodes_of(cell: 'subprocess.Popen[str]') -> dict[str, int]:
    """The cell's child processes: module to process id."""
    listed = subprocess.run(
        ['ps', '--ppid', str(cell.pid), '-o', 'pid=,args='],
        capture_output=True,
        text=True,
        check=True,
    )
    rows = [line.split() for line in listed.stdout.splitlines()]
    return {row[row.index('-m') + 1]: int(row[0]) for row in rows if '-m' in row}


def is_alive(process: int) -> bool:
    return Path(f'/proc/{process}').exists()


def tip_speed(folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Stamps (n,) [s] and speeds (n,) [m/s] of the tip."""
    tip = read_run(folder).pusher
    step = np.diff(tip.stamp) * 1e-9
    return tip.stamp[1:] * 1e-9, np.hypot(*np.diff(tip.values, axis=0).T) / step


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_cell_within_two_seconds_with_its_bag_finished(
    pushing_cell: 'subprocess.Popen[str]', number: signal.Signals, tmp_path: Path
) -> None:
    nodes = nodes_of(pushing_cell)
    assert set(nodes) == {
        'push_sim.sim_node', 'push_gp.gp_server', 'push_mpc.mpc_node', 'push_bag.recorder'
    }  # fmt: skip
    pushing_cell.send_signal(number)
    asked = time.monotonic()
    while any(is_alive(node) for node in nodes.values()):
        assert time.monotonic() - asked < 2.0
        time.sleep(0.01)
    _, err = pushing_cell.communicate(timeout=10)
    assert pushing_cell.returncode == 130
    assert err.splitlines()[-1] == 'cell: interrupted'
    (folder,) = (tmp_path / 'runs').iterdir()
    assert (folder / 'metadata.yaml').exists()
    _, speed = tip_speed(folder)
    assert speed.max() > 0.03
    assert speed[-1] < AT_REST


def test_a_killed_controller_leaves_the_tip_at_rest_and_the_cell_says_why(
    pushing_cell: 'subprocess.Popen[str]', tmp_path: Path
) -> None:
    subprocess.run(['kill', '-KILL', str(nodes_of(pushing_cell)['push_mpc.mpc_node'])], check=True)
    out, err = pushing_cell.communicate(timeout=30)
    assert pushing_cell.returncode == 1
    assert 'mpc_node' in err.splitlines()[-1]
    assert 'signal 9' in err.splitlines()[-1]
    folder = Path(out.splitlines()[-1])
    assert folder.parent == tmp_path / 'runs'
    assert not json.loads((folder / 'score.json').read_text())['completed']
    last_command = read_run(folder).commands.stamp[-1] * 1e-9
    stamp, speed = tip_speed(folder)
    assert speed[stamp > last_command + REST_WITHIN].size > 0
    assert speed[stamp > last_command + REST_WITHIN].max() < AT_REST


def test_a_killed_cell_leaves_no_nodes_behind(pushing_cell: 'subprocess.Popen[str]') -> None:
    nodes = nodes_of(pushing_cell)
    pushing_cell.send_signal(signal.SIGKILL)
    killed = time.monotonic()
    while any(is_alive(node) for node in nodes.values()):
        assert time.monotonic() - killed < 3.0
        time.sleep(0.05)
