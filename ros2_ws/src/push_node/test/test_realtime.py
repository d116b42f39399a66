"""`enter_realtime` runs in a process of its own: it changes the whole process."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import gc, os, resource, threading
from pathlib import Path
from push_core.common import RealtimeSettings
from push_node.realtime import enter_realtime, leave_realtime
{before}
event = threading.Event()
threading.Thread(target=event.wait, daemon=True).start()
got = enter_realtime({mode!r}, RealtimeSettings({wanted}))
threads = [int(each.name) for each in Path('/proc/self/task').iterdir()]
locked = [line for line in Path('/proc/self/status').read_text().splitlines() if 'VmLck' in line]
print(got.text)
print(got.warning)
print(gc.isenabled(), len(threads))
print({{os.sched_getscheduler(each) for each in threads}} == {{os.SCHED_FIFO}})
print(sorted({{core for each in threads for core in os.sched_getaffinity(each)}}))
print(int(locked[0].split()[1]) > 1000)
leave_realtime()
print(os.sched_getscheduler(0) == os.SCHED_OTHER, len(os.sched_getaffinity(0)))
"""
CORES = sorted(os.sched_getaffinity(0))


def outcome(mode: str, wanted: str = '', before: str = '') -> list[str]:
    program = PROGRAM.format(mode=mode, wanted=wanted, before=before)
    command = [sys.executable, '-c', program]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()


def may(number: int) -> bool:
    """Whether this process has a capability, by its number."""
    status = Path('/proc/self/status').read_text(encoding='ascii')
    effective = next(line for line in status.splitlines() if line.startswith('CapEff'))
    return bool(int(effective.split()[1], 16) >> number & 1)


MAY_SCHEDULE, MAY_LOCK = may(23), may(14)


def test_in_lockstep_garbage_is_not_collected_and_the_priority_is_ordinary() -> None:
    text, warning, garbage, *_ = outcome('lockstep', 'cpu=0, lock_memory=True')
    assert (text, warning, garbage) == ('ordinary scheduling', '', 'False 2')


@pytest.mark.skipif(not (MAY_SCHEDULE and MAY_LOCK), reason='needs CAP_SYS_NICE, CAP_IPC_LOCK')
def test_all_threads_get_priority_and_core_and_the_memory_is_locked() -> None:
    core = CORES[-1]
    text, warning, _, fifo, cores, locked, left = outcome(
        'realtime', f'priority=30, cpu={core}, lock_memory=True'
    )
    assert (text, warning) == (f'SCHED_FIFO 30, core {core}, locked memory', '')
    assert (fifo, cores, locked) == ('True', f'[{core}]', 'True')
    # what a helper process inherited, it can give back
    assert left == f'True {len(CORES)}'


def test_what_is_not_asked_for_stays_as_it_is() -> None:
    text, warning, _, fifo, cores, locked, _ = outcome('realtime', 'priority=0')
    assert (text, warning) == ('ordinary scheduling', '')
    assert (fifo, cores, locked) == ('False', str(CORES), 'False')


def test_what_the_kernel_refuses_is_one_warning_and_the_rest_is_kept() -> None:
    # an ordinary user, whose limits permit nothing
    before = """
for limit in (resource.RLIMIT_RTPRIO, resource.RLIMIT_MEMLOCK):
    resource.setrlimit(limit, (0, 0))
if os.geteuid() == 0:
    os.setuid(65534)
"""
    core = CORES[0]
    wanted = f'cpu={core}, lock_memory=True'
    text, warning, _, fifo, cores, locked, _ = outcome('realtime', wanted, before)
    assert text == f'core {core}'
    assert warning.startswith('not permitted here: SCHED_FIFO 20 (Operation not permitted), ')
    assert 'locked memory (the limit is 0 KiB, must be unlimited)' in warning
    assert warning.endswith('; see docs/operating.md')
    assert (fifo, cores, locked) == ('False', f'[{core}]', 'False')


def test_a_core_that_is_not_there_is_named() -> None:
    _, warning, *_ = outcome('realtime', 'priority=0, cpu=1000')
    assert warning.startswith('not permitted here: core 1000 (Invalid argument)')


@pytest.mark.skipif(not MAY_SCHEDULE, reason='needs CAP_SYS_NICE')
def test_a_process_may_have_a_priority_that_those_it_starts_have_not() -> None:
    program = """
import os, subprocess, sys, threading
from push_node.realtime import schedule_alone
event = threading.Event()
thread = threading.Thread(target=event.wait, daemon=True)
thread.start()
schedule_alone(10)
print({os.sched_getscheduler(each) & 0xFF for each in (0, thread.native_id)} == {os.SCHED_FIFO})
child = [sys.executable, '-c', 'import os; print(os.sched_getscheduler(0) == os.SCHED_OTHER)']
print(subprocess.run(child, capture_output=True, text=True).stdout.strip())
schedule_alone(0)
print(os.sched_getscheduler(0) == os.SCHED_OTHER)
"""
    told = subprocess.run(
        [sys.executable, '-c', program], check=True, capture_output=True, text=True
    )
    assert told.stdout.split() == ['True', 'True', 'True']
