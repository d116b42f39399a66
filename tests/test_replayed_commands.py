"""A recorded run, replayed to a running controller, brings the recorded commands again."""

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from cell_command import HANG, Ended

LINE = ('--mode', 'inprocess', '--track', 'line', '--speed', '0.15', '--controller', 'analytical')


@pytest.fixture
def recorded(run_cell: Callable[..., Ended]) -> Path:
    """A run with the lag, the noise and the latency of the real cell."""
    return run_cell(*LINE).folder


@pytest.fixture
def replayed(environment: dict[str, str]) -> Callable[..., Ended]:
    """Runs `push_bag` with the given arguments."""

    def run(*arguments: str) -> Ended:
        return Ended.of_command(environment, 'ros2', 'run', 'push_bag', *arguments)

    return run


@pytest.fixture
def nodes(
    recorded: Path, replayed: Callable[..., Ended], environment: dict[str, str], tmp_path: Path
) -> Iterator[None]:
    """Model server and controller with what the bag says of them."""
    parts = tmp_path / 'parts'
    assert replayed('info', str(recorded), '--extract', str(parts)).status == 0
    options = ['--ros-args', '--params-file', str(parts / 'params.yaml')]
    mine = ['-p', 'mode:=lockstep', '-p', 'require_recorder:=false']
    modules = (['push_gp.server.gp_server'], ['push_mpc.node.mpc_node', *mine])
    # the real `ros2 run` hands no signal on to its node
    commands = [[sys.executable, '-m', module, *options, *rest] for module, *rest in modules]
    started = [
        subprocess.Popen(command, env=environment, stderr=subprocess.DEVNULL)
        for command in commands
    ]
    yield
    for process in started:
        process.terminate()
        process.wait(timeout=HANG)


def test_a_running_controller_sends_the_recorded_commands_bit_for_bit(
    nodes: None, recorded: Path, replayed: Callable[..., Ended]
) -> None:
    found = replayed('replay', str(recorded), '--ask')
    assert found.status == 0, found.out + found.err
    same, _, all_of_them, *rest = found.out.split()
    assert int(same) == int(all_of_them) > 300
    assert ' '.join(rest) == 'commands are the same, bit for bit'
