"""Test processes that run at the same time keep out of each other's way."""

import fcntl
import os
import subprocess
import sys
import tempfile
from pathlib import Path

HELPERS = Path(__file__).parent


def python(program: str, **variables: str) -> 'subprocess.Popen[str]':
    return subprocess.Popen(
        [sys.executable, '-u', '-c', f'from node_tests import *\n{program}'],
        env={**os.environ, 'PYTHONPATH': f'{HELPERS}:{os.environ["PYTHONPATH"]}', **variables},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )


def test_processes_share_no_domain_and_leave_the_users_alone() -> None:
    program = 'print(*[own_domain() for _ in range(20)]); input()'
    taken = []
    processes = [python(program, ROS_DOMAIN_ID='7') for _ in range(3)]
    for process in processes:
        assert process.stdout is not None
        taken += process.stdout.readline().split()
    for process in processes:
        process.communicate('\n')
    assert len(set(taken)) == 60
    assert not {'0', '7'} & set(taken)


def test_a_domain_is_free_again_when_its_process_has_ended() -> None:
    number = python('print(own_domain())').communicate()[0].strip()
    name = f'push_cell_test_{os.getuid()}_{number}.lock'
    with (Path(tempfile.gettempdir()) / name).open('a', encoding='utf-8') as lock:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)  # raises while another holds it
