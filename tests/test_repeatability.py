"""The same seed gives the same trajectory, whatever the mode and however busy the machine."""

import os
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from busy_lockstep import busy_cores, missing_messages
from cell_command import CELL, HANG, Ended, is_pushing, wait_until
from push_bag.replay.recompute import Changes, recomputed
from push_bag.run.run_reader import read_run
from push_msgs.msg import ControllerState

LAP = ('--track', 'line', '--speed', '0.15', '--perturb', 'tangential', '--profile', 'harsh')


def recorder_of(pid: int) -> int | None:
    """Process id of the recorder below a process."""
    for child in Path(f'/proc/{pid}/task/{pid}/children').read_text().split():
        if b'recorder' in Path(f'/proc/{child}/cmdline').read_bytes():
            return int(child)
        if (found := recorder_of(int(child))) is not None:
            return found
    return None


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
    assert missing_messages(busy.folder) == {}
    for run in (busy, in_process):
        again = recomputed(run.folder, Changes())
        assert (again.differs.sum(), again.skipped) == (0, 0)


def test_a_recorder_that_does_not_run_for_a_second_misses_nothing_in_lockstep(
    environment: dict[str, str], tmp_path: Path
) -> None:
    lap = [*CELL, '--mode', 'lockstep', '-o', str(tmp_path)]
    with subprocess.Popen(lap, env=environment, stdout=subprocess.PIPE, text=True) as cell:
        wait_until(lambda: is_pushing(tmp_path), cell)
        recorder = recorder_of(cell.pid)
        assert recorder is not None
        for _ in range(2):
            os.kill(recorder, signal.SIGSTOP)
            time.sleep(1.0)
            os.kill(recorder, signal.SIGCONT)
            time.sleep(0.2)
        assert cell.poll() is None, 'the lap was over before the recorder was stopped twice'
        out, _ = cell.communicate(timeout=HANG)
    assert cell.returncode == 0
    assert missing_messages(Path(out.splitlines()[-1])) == {}


def test_the_family_of_modes_decides_the_same_in_both_modes(
    run_cell: Callable[..., Ended],
) -> None:
    lap = (*LAP, '--controller', 'analytical', '--seed', '3')
    in_step, in_process = (run_cell(*lap, '--mode', mode) for mode in ('lockstep', 'inprocess'))
    assert (in_step.status, in_process.status) == (0, 0)
    np.testing.assert_array_equal(trajectory(in_process.folder), trajectory(in_step.folder))
