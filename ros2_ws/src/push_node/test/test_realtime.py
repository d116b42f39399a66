"""`enter_realtime` runs in a process of its own: it changes the whole process."""

import subprocess
import sys

PROGRAM = """
import gc, os
from push_node.realtime import enter_realtime
print(enter_realtime({mode!r}))
print(gc.isenabled(), os.sched_getscheduler(0) == os.SCHED_FIFO)
"""


def outcome(mode: str) -> list[str]:
    command = [sys.executable, '-c', PROGRAM.format(mode=mode)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()


def test_in_lockstep_garbage_is_not_collected_and_the_priority_is_ordinary() -> None:
    assert outcome('lockstep') == ['ordinary scheduling', 'False False']


def test_in_real_time_it_says_which_scheduling_the_process_got() -> None:
    text, state = outcome('realtime')
    expected = 'real-time scheduling' if state == 'False True' else 'ordinary scheduling'
    assert text.startswith(expected)
    assert state.startswith('False')
