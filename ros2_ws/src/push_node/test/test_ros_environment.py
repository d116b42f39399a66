"""Environments in which ROS cannot start, and what is said then; each node is a real process."""

import os
import subprocess
import sys

import pytest

STARTING = """
import sys
from push_core.console import console_script

class Module:
    def main():
        from rclpy.node import Node
        from push_node.spin import run_node
        class Tested(Node):
            def __init__(self):
                super().__init__('tested')
                sys.stdout.write('started')
                from push_node.spin import request_stop
                request_stop()
        return run_node(Tested)

sys.modules['module'] = Module
sys.exit(console_script('module')())
"""
WITHOUT_ROS = """
import sys
from push_core.console import console_script

class Module:
    def main():
        import rclpy
        sys.stdout.write('done')
        return 0

sys.modules['module'] = Module
sys.exit(console_script('module')())
"""


def run(program, *arguments, **variables):
    environment = {**os.environ, **variables}
    return subprocess.run(
        [sys.executable, '-c', program, *arguments],
        env={name: value for name, value in environment.items() if value is not None},
        capture_output=True,
        text=True,
        check=False,
    )


def unset(*names):
    return dict.fromkeys(names)


@pytest.mark.processes
@pytest.mark.parametrize(
    ('variables', 'line'),
    [
        (
            unset('HOME', 'ROS_HOME', 'ROS_LOG_DIR'),
            'no place for the logs of ROS, HOME is not set: set ROS_LOG_DIR to a folder that can '
            'be written',
        ),
        (
            {**unset('ROS_HOME', 'ROS_LOG_DIR'), 'HOME': '/proc/1'},
            'no place for the logs of ROS, /proc/1/.ros/log cannot be written: set ROS_LOG_DIR to '
            'a folder that can be written',
        ),
        (
            {'ROS_LOG_DIR': '/dev/null/log'},
            'no place for the logs of ROS, /dev/null/log cannot be written: set ROS_LOG_DIR to a '
            'folder that can be written',
        ),
        (
            {'ROS_DOMAIN_ID': 'lab'},
            "ROS_DOMAIN_ID is 'lab', must be a whole number from 0 to 232",
        ),
        (
            {'ROS_DOMAIN_ID': '1000'},
            "ROS_DOMAIN_ID is '1000', must be a whole number from 0 to 232",
        ),
        (
            {'RMW_IMPLEMENTATION': 'rmw_of_nobody'},
            'RMW_IMPLEMENTATION is rmw_of_nobody, which is not installed: install it, or unset '
            'the variable; installed: ',
        ),
    ],
)
def test_a_node_says_in_one_line_what_to_set(variables, line) -> None:
    done = run(STARTING, **variables)
    assert (done.returncode, done.stdout) == (2, '')
    assert done.stderr.startswith(f'tested: {line}')
    assert done.stderr.count('\n') == 1


@pytest.mark.processes
@pytest.mark.parametrize(
    'variables',
    [
        {**unset('ROS_LOG_DIR', 'HOME'), 'ROS_HOME': '{tmp}/made'},
        {**unset('HOME'), 'ROS_LOG_DIR': '{tmp}/made/log'},
        {'ROS_DOMAIN_ID': ''},
        {'RMW_IMPLEMENTATION': ''},
        {'LC_ALL': 'C'},
        {'LANG': 'de_DE.UTF-8', 'TZ': 'Asia/Tokyo'},
    ],
)
def test_it_starts_with_what_it_needs(variables, tmp_path) -> None:
    filled = {name: value and value.format(tmp=tmp_path) for name, value in variables.items()}
    done = run(STARTING, **filled)
    assert (done.returncode, done.stdout, done.stderr) == (0, 'started', '')


def test_a_command_without_ros_runs_whatever_the_middleware() -> None:
    done = run(WITHOUT_ROS, RMW_IMPLEMENTATION='rmw_of_nobody')
    assert (done.returncode, done.stdout, done.stderr) == (0, 'done', '')


@pytest.mark.processes
@pytest.mark.parametrize('value', ['1', '0.5', 'yess', '"true"'])
def test_a_use_sim_time_that_is_no_bool_is_refused(value, tmp_path) -> None:
    text = value.strip('"')
    for arguments in (
        ['-p', f'use_sim_time:={value}'],
        ['-p', f'tested:use_sim_time:={value}'],
    ):
        done = run(STARTING, '--ros-args', *arguments)
        assert (done.returncode, done.stdout) == (2, '')
        assert done.stderr.startswith('tested: parameter use_sim_time takes bool, not ')
        assert text in done.stderr
        assert done.stderr.count('\n') == 1


@pytest.mark.processes
@pytest.mark.parametrize('value', ['true', 'false', 'True', 'yes', 'off'])
def test_one_that_is_a_bool_is_taken(value) -> None:
    done = run(STARTING, '--ros-args', '-p', f'use_sim_time:={value}')
    assert (done.returncode, done.stdout) == (0, 'started')
