"""Four nodes that were started by hand are recorded with all that a recomputation needs."""

import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from cell_command import HANG, Ended
from push_bag.file.reader import BagReader
from push_bag.score.score import score_run
from push_core.data.push_set import PushSet
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider
from push_gp.models.model_file import save_model
from push_gp.training.train import train

SPEED = ('-p', 'speed:=0.15')
LOCKSTEP = ('-p', 'mode:=lockstep')


@pytest.fixture
def model(tmp_path: Path) -> Path:
    """A model file of 40 pushes."""
    generator = np.random.default_rng(3)
    p_y, beta = generator.uniform(-0.04, 0.04, 40), generator.uniform(0.3, 2.8, 40)
    rates, _ = MotionCone(Slider()).evaluate(p_y, beta)
    noise = generator.normal(size=(40, 3)) * [1e-4, 1e-4, 4e-3]
    path = tmp_path / 'by_hand.npz'
    save_model(path, train(PushSet(p_y, beta, 0.004 * rates + noise, 0.004)))
    return path


@pytest.fixture
def by_hand(
    environment: dict[str, str], tmp_path: Path
) -> Iterator[Callable[..., 'subprocess.Popen[bytes]']]:
    """Starts nodes one by one; ends those that still run after the test."""
    started: list[subprocess.Popen[bytes]] = []

    def start(package: str, node: str, *parameters: str) -> 'subprocess.Popen[bytes]':
        command = ['ros2', 'run', package, node, '--ros-args', *parameters]
        # run in a session of its own, `ros2 run` and its node get one signal
        started.append(
            subprocess.Popen(command, env=environment, cwd=tmp_path, start_new_session=True)
        )
        return started[-1]

    yield start
    for process in started:
        if process.poll() is None:
            process.kill()
        process.wait()


def recorded_run(folder: Path) -> dict:
    """The score of a bag that may still be written; empty until it can be scored."""
    try:
        return score_run(folder)
    except ValueError:
        return {}


def test_a_run_of_nodes_started_by_hand_recomputes_bit_for_bit(
    by_hand: Callable[..., 'subprocess.Popen[bytes]'],
    model: Path,
    environment: dict[str, str],
    tmp_path: Path,
) -> None:
    by_hand('push_sim', 'sim_node', *LOCKSTEP, '-p', 'seed:=11')
    by_hand('push_gp', 'gp_server', '-p', f'model:={model.name}')
    by_hand('push_mpc', 'mpc_node', *LOCKSTEP, *SPEED, '-p', 'track:=line')
    recorder = by_hand('push_bag', 'recorder', '-p', 'folder:=run1')
    started = Ended.of_command(environment, 'ros2', 'run', 'push_bringup', 'start')
    assert started.status == 0, started.err
    deadline = time.monotonic() + HANG
    while not recorded_run(tmp_path / 'run1').get('completed'):
        assert time.monotonic() < deadline, recorded_run(tmp_path / 'run1')
        time.sleep(0.5)
    recorder.send_signal(signal.SIGINT)
    assert recorder.wait(timeout=HANG) == 0

    reader = BagReader(tmp_path / 'run1')
    assert sum(1 for _ in reader.records()) > 1000
    assert reader.attachments['by_hand.npz'] == model.read_bytes()
    facts = {name: reader.facts[name] for name in ('track', 'mode', 'seed', 'profile', 'laps')}
    assert facts == {
        'track': 'line',
        'mode': 'lockstep',
        'seed': '11',
        'profile': 'irb120',
        'laps': '1',
    }
    model.unlink()
    again = Ended.of_command(
        environment, 'ros2', 'run', 'push_bag', 'replay', str(tmp_path / 'run1'), '--recompute'
    )
    assert again.status == 0, again.out + again.err
    same, _, count, *_ = again.out.split()
    assert int(same) == int(count) > 300
