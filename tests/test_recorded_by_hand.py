"""Four nodes that were started by hand are recorded with all that a recomputation needs."""

import os
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from cell_command import HANG, Ended, wait_until_ended
from push_bag.file.reader import BagReader
from push_bag.replay.recompute import Changes, recomputed
from push_bag.run.run_reader import read_starts
from push_bag.score.score import score_run, score_series
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


def push_twice(
    by_hand: Callable[..., 'subprocess.Popen[bytes]'], environment: dict[str, str], folder: Path
) -> None:
    """Records two complete runs as run1 in a folder."""
    recorder = by_hand('push_bag', 'recorder', '-p', 'folder:=run1')
    for number in (1, 2):
        started = Ended.of_command(environment, 'ros2', 'run', 'push_bringup', 'start')
        assert started.status == 0, started.err
        assert not wait_until_ended(folder / 'run1', number).stop_reason
    os.killpg(recorder.pid, signal.SIGINT)
    assert recorder.wait(timeout=HANG) == 0


def test_two_runs_that_begin_where_the_object_lies_recompute_bit_for_bit(
    by_hand: Callable[..., 'subprocess.Popen[bytes]'],
    environment: dict[str, str],
    tmp_path: Path,
) -> None:
    """The second one begins where the first one left the object; nothing is reset."""
    (tmp_path / 'arc.csv').write_text('3,3\n3.1,3.01\n3.2,3.04\n3.3,3.09\n')
    begin = [option for name in ('x', 'y') for option in ('-p', f'start.{name}:=-0.2')]
    by_hand('push_sim', 'sim_node', *LOCKSTEP, *begin, '-p', 'start.gap:=0.002')
    by_hand('push_gp', 'gp_server')
    here = ('-p', 'start_from:=here', '-p', 'controller:=analytical', '-p', 'track:=arc.csv')
    by_hand('push_mpc', 'mpc_node', *LOCKSTEP, *SPEED, *here)
    push_twice(by_hand, environment, tmp_path)

    first, second = read_starts(tmp_path / 'run1')
    assert first.reference is not None
    assert second.reference is not None
    np.testing.assert_array_equal(first.reference.pose[0], first.object.values[0])
    assert first.reference.pose[0] == pytest.approx([-0.2, -0.2, 0.0], abs=0.005)
    # the tip comes to rest after the end of the reference
    assert second.reference.pose[0] == pytest.approx(first.reference.pose[-1], abs=0.06)
    for run in (first, second):
        assert score_series(run)['tracking_error_mm']['mean'] < 2.0
    (tmp_path / 'arc.csv').unlink()
    again = recomputed(tmp_path / 'run1', Changes())
    assert again.stamp.size > 300
    assert again.same


def test_two_runs_of_nodes_started_by_hand_are_scored_apart_and_recompute_bit_for_bit(
    by_hand: Callable[..., 'subprocess.Popen[bytes]'],
    model: Path,
    environment: dict[str, str],
    tmp_path: Path,
) -> None:
    by_hand('push_sim', 'sim_node', *LOCKSTEP, '-p', 'seed:=11')
    by_hand('push_gp', 'gp_server', '-p', f'model:={model.name}')
    by_hand('push_mpc', 'mpc_node', *LOCKSTEP, *SPEED, '-p', 'track:=line')
    push_twice(by_hand, environment, tmp_path)

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
    first, second = score_run(tmp_path / 'run1')['starts']
    # the plant was put back to the same state, and everything random with it; the predictor of
    # the second start still knows the last commands of the first
    assert first['tracking_error_mm'] == pytest.approx(second['tracking_error_mm'], rel=0.02)
    assert first['duration_s'] == second['duration_s']
    model.unlink()
    again = Ended.of_command(
        environment, 'ros2', 'run', 'push_bag', 'replay', str(tmp_path / 'run1'), '--recompute'
    )
    assert again.status == 0, again.out + again.err
    same, _, count, *_ = again.out.split()
    assert int(same) == int(count) > 600
