"""The commands of README and docs do what they say, in a folder with the files that they name."""

import csv
import itertools
import os
import shlex
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import numpy as np
import pytest
import rclpy
from cell_command import HANG, Ended
from documented import MARK, PAGES, ROOT, Shown, languages, shown
from push_bag.run.run_reader import read_run
from push_core.data.robot_run import COLUMNS
from rclpy.context import Context

pytestmark = pytest.mark.processes

SHOWN = shown()
SLOW = os.environ.get('SLOW') == 'yes'
RUN = [each for each in SHOWN if not each.not_run and (SLOW or not each.slow)]
# what runs until Ctrl-C, and the name of its node
NODES = {
    'sim_node': 'sim_node',
    'gp_server': 'gp_server',
    'mpc_node': 'mpc_node',
    'recorder': 'recorder',
    'live': 'live',
    'examples/robot_driver.py': 'robot',
    '--loop': 'replay',
}
DATA = '../shared/data'
DRAWINGS = ('', 'mermaid')
LIVE_PORT = 8765
PREPARED = """
ros2 run push_sim collect --pushes 300 --seed 0 -o pushes.csv
ros2 run push_sim collect --pushes 100 --seed 1 -o heldout.csv
ros2 run push_gp train pushes.csv --points 50 -o MODEL.npz
ros2 run push_bringup cell --track line --mode inprocess --model MODEL.npz -o runs
mv runs/* runs/RUN
cp MODEL.npz model.npz
printf '%s\\n' 0,0 0.1,0 0.2,0.01 0.3,0.03 > my_path.csv
head -c 400000 runs/RUN/*.mcap > BROKEN
"""
Observer = Callable[[], list[str]]


@pytest.fixture(scope='module')
def prepared(
    environment: dict[str, str], tmp_path_factory: pytest.TempPathFactory, measured: Path | None
) -> Path:
    """A folder with the files that the commands name, beside that of the measured data."""
    folder = tmp_path_factory.mktemp('documented') / 'work'
    folder.mkdir()
    script = ('bash', '-ec', f'cd {folder}\n{PREPARED}')
    ended = Ended.of_command(environment, *script)
    assert ended.status == 0, ended.err
    write_robot_run(folder / 'runs/RUN', folder / 'robot_run.csv')
    (folder / 'examples').symlink_to(ROOT / 'examples')
    if measured:
        (folder.parent / 'shared').mkdir()
        (folder.parent / 'shared/data').symlink_to(measured)
    return folder


def write_robot_run(run: Path, path: Path) -> None:
    """A recorded run in the form of the measured ones; its command leads the tip by 0.1 s."""
    recorded = read_run(run)
    time_s = 1e-9 * (recorded.object.stamp - recorded.object.stamp[0])
    instants = np.arange(0.0, time_s[-1], 0.002)

    def at(values: np.ndarray, lead: float = 0.0) -> list[np.ndarray]:
        return [np.interp(instants + lead, time_s, column) for column in values.T]

    tip = recorded.pusher.values[:, :2]
    table = np.column_stack([instants, *at(recorded.object.values), *at(tip, 0.1), *at(tip)])
    with path.open('w', newline='') as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        writer.writerows(table.tolist())


@pytest.fixture
def folder(prepared: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the prepared folder, which is the working folder."""
    shutil.copytree(prepared.parent, tmp_path / 'copy', symlinks=True)
    monkeypatch.chdir(tmp_path / 'copy/work')
    return tmp_path / 'copy/work'


@pytest.fixture(scope='module')
def node_names(environment: dict[str, str]) -> Iterator[Observer]:
    """Tells the names of the nodes that run."""
    context = Context()
    rclpy.init(context=context, domain_id=int(environment['ROS_DOMAIN_ID']))
    observer = rclpy.create_node('observer', context=context)
    yield observer.get_node_names
    observer.destroy_node()
    context.try_shutdown()


def node_of(command: str) -> str:
    """Name of the node that the command runs until Ctrl-C; empty if it ends by itself."""
    return next((NODES[word] for word in shlex.split(command) if word in NODES), '')


@contextmanager
def running(command: str, environment: dict[str, str], node_names: Observer) -> Iterator[None]:
    """Runs a node, from the moment the others see it until Ctrl-C."""
    shell = ['bash', '-c', f'exec {command}']
    end = time.monotonic() + HANG
    # a node of the block before may still be in the graph
    while node_of(command) in node_names():
        assert time.monotonic() < end, f'{command}: another one runs'
        time.sleep(0.05)
    process = subprocess.Popen(shell, env=environment, start_new_session=True)
    try:
        while node_of(command) not in node_names():
            assert process.poll() is None, f'{command}: ended with status {process.returncode}'
            assert time.monotonic() < end, f'{command}: did not start'
            time.sleep(0.05)
        yield
        # as a terminal does: the real `ros2 run` hands no signal on to its node
        os.killpg(process.pid, signal.SIGINT)
        status = process.wait(HANG)
        assert status in (0, 130), f'{command}: ended with status {status}'
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)


def needs_what_is_not_there(each: Shown) -> str:
    """Why this machine cannot run the commands; empty if it can."""
    if any(DATA in command for command in each.commands) and not Path(DATA).exists():
        return 'no measured data; PUSH_DATA_DIR names their folder'
    if 'live' in map(node_of, each.commands) and is_taken(LIVE_PORT):
        return f'port {LIVE_PORT} is taken'
    return ''


def is_taken(port: int) -> bool:
    with socket.socket() as probe:
        return not probe.connect_ex(('127.0.0.1', port))


@pytest.mark.parametrize('each', RUN, ids=lambda each: each.place)
def test_the_commands_of_a_block_or_row_end_well(
    each: Shown, folder: Path, environment: dict[str, str], node_names: Observer
) -> None:
    if reason := needs_what_is_not_there(each):
        pytest.skip(reason)
    with ExitStack() as nodes:
        for command in (*each.beside, *(f'{command}{each.options}' for command in each.commands)):
            if node_of(command):
                nodes.enter_context(running(command, environment, node_names))
            else:
                ended = Ended.of_command(
                    environment, 'bash', '-c', command, timeout=12 * HANG if each.slow else HANG
                )
                assert ended.status == 0, f'{command}\n{ended.out}{ended.err}'


def test_most_commands_are_run() -> None:
    assert sum(len(each.commands) for each in RUN) > 45


def test_a_block_that_is_no_drawing_is_run_here_or_by_test_extending() -> None:
    kinds = {(page, language) for page, language in languages() if language not in DRAWINGS}
    assert kinds <= {('extending.md', 'python')}


def test_every_mark_stands_at_commands() -> None:
    written = sum(len(MARK.findall(page.read_text(encoding='utf-8'))) for page in PAGES)
    read = [(each.not_run, each.slow, each.options, each.beside) for each in SHOWN]
    assert written == sum(map(bool, itertools.chain(*read)))


def test_the_tests_that_marks_name_are_there() -> None:
    named = {word.strip(';,') for each in SHOWN for word in each.not_run.split() if '/' in word}
    assert [path for path in named if not (ROOT / path).is_file()] == []
