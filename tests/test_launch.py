"""`ros2 launch push_bringup cell.launch.py`, where the real launch is installed."""

import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

for needed in ('launch_ros.actions', 'ros2launch.api'):
    pytest.importorskip(
        needed, reason='the real launch of ROS is not installed', exc_type=ImportError
    )

LAUNCH = ('ros2', 'launch', 'push_bringup', 'cell.launch.py')
LINE = ('track:=line', 'controller:=analytical', 'mode:=lockstep')
HANG = 120.0  # [s]; nothing but a hang takes that long


class Launched:
    """A launch in a process group of its own, and its output so far."""

    def __init__(self, environment: dict[str, str], folder: Path, *arguments: str) -> None:
        self.folder = folder
        self._log = folder / f'launch_{time.monotonic_ns()}.log'
        with self._log.open('wb') as output:
            self.process = subprocess.Popen(
                [*LAUNCH, *arguments],
                cwd=folder,
                env=environment,
                stdout=output,
                stderr=output,
                start_new_session=True,
            )

    @property
    def output(self) -> str:
        return self._log.read_text(encoding='utf-8')

    def wait_for(self, text: str) -> None:
        deadline = time.monotonic() + HANG
        while text not in self.output:
            assert self.process.poll() is None, self.output
            assert time.monotonic() < deadline, self.output
            time.sleep(0.1)

    def press_ctrl_c(self) -> None:
        """As a terminal does: the whole group is interrupted."""
        os.killpg(self.process.pid, signal.SIGINT)

    def wait(self) -> str:
        self.process.wait(timeout=HANG)
        return self.output

    def bags(self) -> list[Path]:
        return sorted((self.folder / 'runs').glob('*'))


@pytest.fixture
def launched(environment: dict[str, str], tmp_path: Path) -> Iterator[Callable[..., Launched]]:
    started: list[Launched] = []

    def launch(*arguments: str) -> Launched:
        started.append(Launched(environment, tmp_path, *arguments))
        return started[-1]

    yield launch
    for each in started:
        if each.process.poll() is None:
            os.killpg(each.process.pid, signal.SIGKILL)
            each.process.wait()


def is_quiet(output: str) -> bool:
    return not any(word in output for word in ('has died', 'Traceback', 'exit code'))


def test_launches_in_a_row_leave_a_finished_bag_each_and_end_quietly(launched) -> None:
    for number in range(2):
        cell = launched(*LINE, 'autostart:=true')
        cell.wait_for('tracking -> done')
        cell.press_ctrl_c()
        # the impatient press it twice
        cell.press_ctrl_c()
        assert is_quiet(cell.wait()), cell.output
        assert len(cell.bags()) == number + 1
    assert all((bag / 'metadata.yaml').is_file() for bag in cell.bags())


def test_the_bag_of_a_launch_recomputes_bit_for_bit(environment, launched) -> None:
    cell = launched(*LINE, 'autostart:=true', 'namespace:=left')
    cell.wait_for('tracking -> done')
    cell.press_ctrl_c()
    cell.wait()
    command = ['ros2', 'run', 'push_bag', 'replay', str(cell.bags()[0]), '--recompute']
    again = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert again.returncode == 0, again


def test_a_node_that_dies_ends_all_and_is_named(launched) -> None:
    cell = launched(*LINE, 'record:=false')
    cell.wait_for('as a table')
    pid = int(cell.output.split('[sim_node-1]: process started with pid [')[1].split(']')[0])
    os.kill(pid, signal.SIGKILL)
    output = cell.wait()
    assert '[sim_node-1]: process has died' in output
    assert 'process[sim_node-1] was required: shutting down' in output
    assert output.count('has finished cleanly') == 2


@pytest.mark.parametrize(
    ('argument', 'message'),
    [
        ('trak:=square', "unknown argument 'trak'"),
        ('controller:=pid', 'Valid options are'),
        ('track:=triangle', "unknown track 'triangle'"),
    ],
)
def test_a_wrong_argument_starts_nothing(launched, argument, message) -> None:
    output = launched('controller:=analytical', argument).wait()
    assert message in output
    assert 'process started' not in output
