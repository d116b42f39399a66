"""The cell as a user runs it: `ros2 run push_bringup cell …` in processes of its own."""

import os
import signal
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from ament_index_python import get_package_prefix
from cell_command import PATIENT, Ended, is_pushing, wait_until
from node_tests import own_domain


@pytest.fixture(scope='session', autouse=True)
def _interrupts_heard() -> None:
    """Also where the tests run in the background, which ignores Ctrl-C."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope='session')
def environment(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Variables for all commands; one cache, so that the default model is learned once."""
    cache = tmp_path_factory.mktemp('cache')
    return {**os.environ, 'ROS_DOMAIN_ID': own_domain(), 'XDG_CACHE_HOME': str(cache)}


@pytest.fixture(scope='session')
def measured() -> Path | None:
    """Folder of the measured data, where there is one."""
    beside_the_project = Path(__file__).parents[2] / 'shared' / 'data'
    folder = Path(os.environ.get('PUSH_DATA_DIR', beside_the_project))
    return folder.absolute() if folder.is_dir() else None


@pytest.fixture
def run_cell(environment: dict[str, str], tmp_path: Path) -> Callable[..., Ended]:
    """Runs the cell to its end with the given arguments."""

    def run(*arguments: str) -> Ended:
        return Ended.of(environment, *arguments, '-o', str(tmp_path / 'runs'))

    return run


@pytest.fixture
def pushing_cell(environment: dict[str, str], tmp_path: Path) -> Iterator['subprocess.Popen[str]']:
    """A realtime cell that has been pushing for a second."""
    runs = tmp_path / 'runs'
    # the real `ros2 run` hands no signal on to the cell
    command = Path(get_package_prefix('push_bringup')) / 'lib/push_bringup/cell'
    cell = subprocess.Popen(
        [command, *PATIENT, '--speed', '0.05', '-o', str(runs)],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    wait_until(lambda: is_pushing(runs), cell)
    yield cell
    if cell.poll() is None:
        cell.send_signal(signal.SIGKILL)
    cell.communicate()


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
            # the real `ros2 run` hands no signal on to its node
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
