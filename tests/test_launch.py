"""`ros2 launch push_bringup cell.launch.py`, where the real launch is installed."""

import os
import signal
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from launch_command import LINE, Launched, is_quiet

for needed in ('launch_ros.actions', 'ros2launch.api'):
    pytest.importorskip(
        needed, reason='the real launch of ROS is not installed', exc_type=ImportError
    )


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


def test_launches_in_a_row_leave_a_finished_bag_each_and_end_quietly(launched) -> None:
    for number in range(2):
        cell = launched(*LINE, 'autostart:=true')
        cell.wait_for('stopping -> done')
        cell.press_ctrl_c()
        # the impatient press it twice
        cell.press_ctrl_c()
        assert is_quiet(cell.wait()), cell.output
        assert len(cell.bags()) == number + 1
    assert all((bag / 'metadata.yaml').is_file() for bag in cell.bags())


def test_the_bag_of_a_launch_recomputes_bit_for_bit(environment, launched) -> None:
    cell = launched(*LINE, 'autostart:=true', 'namespace:=left')
    cell.wait_for('stopping -> done')
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
