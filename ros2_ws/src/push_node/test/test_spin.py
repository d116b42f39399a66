"""Each node is a real process; what it does is in the few lines of its program."""

import gc
import os
import signal
import time
import weakref
from pathlib import Path
from typing import NoReturn

import pytest
from push_core.common.errors import InputError
from push_node.spin import Spinner, run_node
from rclpy.node import Node

pytestmark = pytest.mark.processes

PATIENCE = 60.0  # [s]; nothing but a hang takes that long

PROGRAM = """
import os
import sys
from push_core.common.errors import InputError, PushError, RunError
from push_node.spin import request_stop, run_node
from rclpy.node import Node

class Tested(Node):
    def __init__(self):
        super().__init__('tested')
        {construction}
        self.timer = self.create_timer(0.01, self.tick)
        sys.stdout.write('ready\\n')
        sys.stdout.flush()

    def tick(self):
        {tick}

    def destroy_node(self):
        sys.stdout.write('cleaned up\\n')
        super().destroy_node()

sys.exit(run_node(Tested))
"""
# sends a signal while the interpreter ends, which has then reset its own handlers
LATE_SIGNAL = """
import os

class Late:
    def __del__(self, kill=os.kill, own=os.getpid()):
        kill(own, {number:d})

late = Late()
"""


def cpu_seconds(pid: int) -> float:
    fields = Path(f'/proc/{pid}/stat').read_text().rsplit(')', 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


@pytest.fixture
def node(started):
    def start(*arguments, construction='pass', tick='pass'):
        return started(PROGRAM.format(construction=construction, tick=tick), *arguments)

    return start


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_cleaned_up_with_status_0(node, number) -> None:
    process = node()
    assert process.stdout.readline() == 'ready\n'
    process.send_signal(number)
    output, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0
    assert output == 'cleaned up\n'
    assert errors == ''


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_further_signals_while_it_ends_change_nothing(started, number) -> None:
    program = PROGRAM.format(construction='pass', tick='pass')
    process = started(LATE_SIGNAL.format(number=number) + program)
    assert process.stdout.readline() == 'ready\n'
    process.send_signal(number)
    _, errors = process.communicate(timeout=PATIENCE)
    assert (process.returncode, errors) == (0, '')


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_after_a_signal_no_further_callback_runs(node, number) -> None:
    tick = f"sys.stdout.write('tick\\n'); os.kill(os.getpid(), {number:d})"
    output, _ = node(tick=tick).communicate(timeout=PATIENCE)
    assert output == 'ready\ntick\ncleaned up\n'


def test_an_idle_node_leaves_the_core_alone(node) -> None:
    process = node()
    assert process.stdout.readline() == 'ready\n'
    before = cpu_seconds(process.pid)
    time.sleep(1.0)
    assert cpu_seconds(process.pid) - before < 0.5


@pytest.mark.parametrize(
    ('error', 'status', 'line'),
    [
        ("InputError('no such model')", 2, 'tested: no such model'),
        ("RunError('no simulator')", 1, 'tested: no simulator'),
        ("FileNotFoundError(2, 'No such file', 'a.csv')", 1, 'tested: a.csv: No such file'),
        ("RuntimeError('no memory')", 2, 'tested: cannot start: no memory'),
    ],
)
def test_an_error_in_the_constructor_is_one_line_and_its_status(node, error, status, line) -> None:
    process = node(construction=f'raise {error}')
    _, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == status
    assert errors == line + '\n'


def test_an_error_in_a_callback_ends_it_cleaned_up_with_status_1(node) -> None:
    process = node(tick="raise RunError('the tip is stuck')")
    output, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1
    assert output == 'ready\ncleaned up\n'
    assert errors.splitlines()[-1] == 'tested: the tip is stuck'
    assert 'Traceback' not in errors  # rclpy adds a line of its log


def test_a_mistake_in_a_callback_is_not_hidden(node) -> None:
    process = node(tick='1 / 0')
    output, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1
    assert output == 'ready\ncleaned up\n'
    assert errors.splitlines()[-1] == 'ZeroDivisionError: division by zero'


def test_a_node_can_end_by_itself(node) -> None:
    process = node(tick='request_stop()')
    output, errors = process.communicate(timeout=PATIENCE)
    assert (process.returncode, output, errors) == (0, 'ready\ncleaned up\n', '')


def test_bad_ros_arguments_are_an_error_of_status_2(node) -> None:
    process = node('-p', 'nonsense')
    _, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 2
    assert errors.splitlines()[-1].startswith('tested: bad ROS arguments: ')
    assert 'Traceback' not in errors


def test_asked_for_help_it_tells_and_does_not_start(node) -> None:
    output, errors = node('--', '--help').communicate(timeout=PATIENCE)
    assert '--ros-args -p NAME:=VALUE' in output
    assert 'ready' not in output
    assert errors == ''


def test_an_argument_that_is_none_of_ros_is_refused(node) -> None:
    process = node('--', 'model.npz')
    output, errors = process.communicate(timeout=PATIENCE)
    assert (process.returncode, output) == (2, '')
    assert errors == (
        "tested: unknown argument 'model.npz'; parameters follow --ros-args, see --help\n"
    )


def test_ctrl_c_during_the_imports_ends_it_before_it_is_made_with_status_130(started) -> None:
    program = PROGRAM.format(construction='pass', tick='pass').replace(
        'sys.exit(',
        'from push_core.console import hold_interrupts; hold_interrupts()\n'
        'os.kill(os.getpid(), 2)\nsys.exit(',
    )
    process = started(program)
    output, errors = process.communicate(timeout=PATIENCE)
    assert (process.returncode, output, errors) == (130, '', '')


def test_ctrl_c_while_it_is_made_ends_it_cleaned_up_before_the_first_callback(node) -> None:
    process = node(construction='os.kill(os.getpid(), 2)', tick='1 / 0')
    output, errors = process.communicate(timeout=PATIENCE)
    assert (process.returncode, output, errors) == (0, 'ready\ncleaned up\n', '')


def test_ctrl_c_reaches_a_node_while_a_handler_of_a_library_is_installed(node) -> None:
    # as OSQP's is during a solve; threads of the middleware must not run it either
    tick = (
        "import signal; signal.signal(2, lambda *_: sys.stdout.write('lost\\n')); "
        'os.kill(os.getpid(), 2)'
    )
    process = node(tick=tick)
    output, _ = process.communicate(timeout=PATIENCE)
    assert (process.returncode, output) == (0, 'ready\ncleaned up\n')


def _refused() -> NoReturn:
    raise InputError('no such node')


def test_a_node_that_ended_leaves_its_process_open_to_signals() -> None:
    assert run_node(_refused, ['--ros-args']) == 2
    assert signal.SIG_IGN not in map(signal.getsignal, (signal.SIGINT, signal.SIGTERM))


@pytest.mark.usefixtures('context')
def test_a_closed_spinner_lets_go_of_its_node() -> None:
    """Else the middleware keeps threads and sockets of every node that the process has had."""
    node = Node('closed')
    node.create_timer(0.01, lambda: None)
    spinner, seen = Spinner(node), weakref.ref(node)
    assert spinner.once()
    spinner.close()
    node.destroy_node()
    del node
    gc.collect()
    assert seen() is None
