"""The same seed gives the same trajectory, whatever the mode and however busy the machine."""

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from cell_command import Ended
from push_bag.replay.recompute import Changes, recomputed
from push_bag.run.run_reader import read_run
from push_msgs.msg import ControllerState

LAP = ('--track', 'line', '--speed', '0.15', '--perturb', 'tangential', '--profile', 'harsh')


@contextmanager
def busy_cores() -> Iterator[None]:
    burners = [
        subprocess.Popen([sys.executable, '-c', 'while True: pass'])
        for _ in range(os.cpu_count() or 1)
    ]
    try:
        yield
    finally:
        for burner in burners:
            burner.kill()
            burner.wait()


def trajectory(folder: Path) -> np.ndarray:
    """Object poses (n, 3) of the ticks that tracked the reference."""
    run = read_run(folder)
    tracking = run.states.stamp[run.state('mode') == ControllerState.TRACKING]
    index, found = run.object.at(tracking)
    assert found.all()
    return np.asarray(run.object.values[index])


def test_lockstep_repeats_bit_for_bit_on_busy_cores_and_agrees_with_in_process(
    run_cell: Callable[..., Ended],
) -> None:
    quiet = run_cell(*LAP, '--mode', 'lockstep', '--seed', '3')
    with busy_cores():
        busy = run_cell(*LAP, '--mode', 'lockstep', '--seed', '3')
    in_process = run_cell(*LAP, '--mode', 'inprocess', '--seed', '3')
    other_seed = run_cell(*LAP, '--mode', 'inprocess', '--seed', '4')

    assert [run.status for run in (quiet, busy, in_process, other_seed)] == [0] * 4
    first, second = trajectory(quiet.folder), trajectory(busy.folder)
    np.testing.assert_array_equal(first, second)
    np.testing.assert_allclose(trajectory(in_process.folder), first, rtol=0.0, atol=1e-9)
    assert not np.array_equal(trajectory(other_seed.folder), first)
    for run in (busy, in_process):
        again = recomputed(run.folder, Changes())
        assert (again.differs.sum(), again.skipped) == (0, 0)


def test_the_family_of_modes_decides_the_same_in_both_modes(
    run_cell: Callable[..., Ended],
) -> None:
    lap = (*LAP, '--controller', 'analytical', '--seed', '3')
    in_step, in_process = (run_cell(*lap, '--mode', mode) for mode in ('lockstep', 'inprocess'))
    assert (in_step.status, in_process.status) == (0, 0)
    np.testing.assert_array_equal(trajectory(in_process.folder), trajectory(in_step.folder))
