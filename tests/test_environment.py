"""env.sh and the ros2 stand-in, run as a user runs them."""

import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
STAND_IN = ROOT / 'scripts/bin/ros2'
PATHS = ('PATH', 'PYTHONPATH', 'AMENT_PREFIX_PATH', 'CMAKE_PREFIX_PATH', 'LD_LIBRARY_PATH')
SHELLS = [
    pytest.param(
        name, marks=pytest.mark.skipif(shutil.which(name) is None, reason=f'no {name} here')
    )
    for name in ('bash', 'zsh')
]


def ros2(prefixes, *arguments):
    return subprocess.run(
        [STAND_IN, *arguments],
        env={'PATH': '/usr/bin:/bin', 'AMENT_PREFIX_PATH': ':'.join(map(str, prefixes))},
        capture_output=True,
        text=True,
        check=False,
    )


def add_package(prefix, name, **executables):
    index = prefix / 'share/ament_index/resource_index/packages'
    index.mkdir(parents=True, exist_ok=True)
    (index / name).touch()
    folder = prefix / 'lib' / name
    folder.mkdir(parents=True)
    for executable, script in executables.items():
        (folder / executable).write_text(f'#!/bin/sh\n{script}\n')
        (folder / executable).chmod(0o755)


@pytest.fixture
def prefix(tmp_path):
    add_package(tmp_path, 'tools', speak='printf "<%s>" "$@"', quit='exit 7', whoami='echo $$')
    (tmp_path / 'lib/tools/notes.txt').write_text('not an executable')
    return tmp_path


def test_run_hands_over_arguments_as_they_are(prefix):
    assert ros2([prefix], 'run', 'tools', 'speak', 'a b', '', '*').stdout == '<a b><><*>'


def test_run_returns_the_status_of_the_executable(prefix):
    assert ros2([prefix], 'run', 'tools', 'quit').returncode == 7


def test_run_becomes_the_executable(prefix):
    with subprocess.Popen(
        [STAND_IN, 'run', 'tools', 'whoami'],
        env={'PATH': '/usr/bin:/bin', 'AMENT_PREFIX_PATH': str(prefix)},
        stdout=subprocess.PIPE,
    ) as process:
        assert process.stdout is not None
        assert int(process.stdout.read()) == process.pid


@pytest.mark.parametrize(
    ('arguments', 'status', 'message'),
    [
        (('run', 'nothing', 'speak'), 1, "Package 'nothing' not found\n"),
        (('run', '', 'speak'), 1, "Package '' not found\n"),
        (('run', 'tools', 'shout'), 1, 'No executable found\n'),
        (('run', 'tools', 'notes.txt'), 1, 'No executable found\n'),
        (('pkg', 'executables', 'nothing'), 1, "Package 'nothing' not found\n"),
        (('run', 'tools'), 2, 'ros2: run needs a package and an executable; see ros2 --help\n'),
        (('topic', 'list'), 2, "ros2: the stand-in knows no command 'topic'; see ros2 --help\n"),
    ],
)
def test_a_mistake_is_one_line(prefix, arguments, status, message):
    result = ros2([prefix], *arguments)
    assert (result.returncode, result.stdout, result.stderr) == (status, '', message)


def test_the_first_prefix_wins(prefix, tmp_path_factory):
    overlay = tmp_path_factory.mktemp('overlay')
    add_package(overlay, 'tools', speak='echo overlay')
    assert ros2([overlay, prefix], 'run', 'tools', 'speak').stdout == 'overlay\n'


def test_executables_are_listed_by_package(prefix):
    add_package(prefix, 'arms', wave='true')
    listed = ros2([prefix], 'pkg', 'executables').stdout.splitlines()
    assert listed == ['arms wave', 'tools quit', 'tools speak', 'tools whoami']
    assert ros2([prefix], 'pkg', 'executables', 'arms').stdout == 'arms wave\n'


def test_help_says_what_the_stand_in_is():
    assert 'stand-in' in ros2([], '--help').stdout


def source(shell, script, **environment):
    """Runs a script in a shell that has nothing of this process's environment."""
    kept = {name: os.environ[name] for name in ('HOME', 'ROS_DISTRO') if name in os.environ}
    return subprocess.run(
        [shell, '-c', script],
        env={'PATH': '/usr/bin:/bin', **kept, **environment},
        cwd='/',
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize('shell', SHELLS)
def test_sourcing_twice_changes_nothing_more(shell):
    show = '; '.join(f'echo "${{{name}:-}}"' for name in PATHS)
    result = source(shell, f'set -eu; . {ROOT}/env.sh; {show}; . {ROOT}/env.sh; {show}')
    assert result.returncode == 0, result.stderr
    lines = result.stdout.splitlines()
    assert lines[: len(PATHS)] == lines[len(PATHS) :]


@pytest.mark.parametrize('shell', SHELLS)
def test_env_leaves_no_names_of_its_own(shell):
    result = source(shell, f'. {ROOT}/env.sh; set; typeset -f')
    assert '_push_' not in result.stdout.replace('_push_msgs', '')


def test_env_keeps_a_discovery_range_that_is_set():
    show = f'. {ROOT}/env.sh; echo $ROS_AUTOMATIC_DISCOVERY_RANGE'
    assert source('bash', show).stdout == 'LOCALHOST\n'
    assert source('bash', show, ROS_AUTOMATIC_DISCOVERY_RANGE='SUBNET').stdout == 'SUBNET\n'


def test_a_real_ros2_goes_before_the_stand_in(tmp_path):
    (tmp_path / 'ros2').write_text('#!/bin/sh\n')
    (tmp_path / 'ros2').chmod(0o755)
    result = source('bash', f'. {ROOT}/env.sh; command -v ros2', PATH=f'{tmp_path}:/usr/bin:/bin')
    assert result.stdout.strip() == str(tmp_path / 'ros2')


def test_env_of_a_fresh_clone_says_what_to_do(tmp_path):
    shutil.copy(ROOT / 'env.sh', tmp_path)
    result = source('bash', f'. {tmp_path}/env.sh')
    assert result.returncode == 1
    message = f"env.sh: the cell is not set up: run 'make setup' in {tmp_path} first\n"
    assert result.stderr == message


@pytest.mark.parametrize('seconds', [0.0, 0.01, 0.03, 0.06])
def test_ctrl_c_at_the_start_of_a_command_is_no_traceback(seconds):
    command = subprocess.Popen(
        ['ros2', 'run', 'push_bag', 'info'],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    time.sleep(seconds)
    os.killpg(command.pid, signal.SIGINT)
    out, err = command.communicate(timeout=60.0)
    assert out == ''
    if command.returncode != -signal.SIGINT:  # not even the shell had begun
        assert (command.returncode, err) in [(130, ''), (130, 'info: interrupted\n')]
