"""Ctrl-C at the worst moments; each command is a real process."""

import signal
import subprocess
import sys
import threading
import time

import pytest
from push_core.common.interrupts import InterruptOnce, InterruptsHeld, take_held_interrupt

CONSOLE = 'import sys; from push_core.console import console_script; sys.exit({})'
IMPORTING = """
import os, signal, sys
os.kill(os.getpid(), signal.SIGINT)
sys.stdout.write('imported\\n')
from push_core.common.command_line import Parser, run_command

def main():
    return run_command(Parser('Works.'), lambda arguments: sys.stdout.write('worked'), [])
"""
PRESSED_TWICE = """
import os, signal, sys
from push_core.common.command_line import Parser, run_command

def work(arguments):
    try:
        os.kill(os.getpid(), signal.SIGINT)
    finally:
        os.kill(os.getpid(), signal.SIGINT)
        sys.stdout.write('cleaned up')

sys.exit(run_command(Parser('Works.'), work, []))
"""


def run(program: str, **options) -> 'subprocess.CompletedProcess[str]':
    return subprocess.run(
        [sys.executable, '-c', program], capture_output=True, text=True, check=False, **options
    )


def test_one_that_comes_during_the_imports_acts_after_them_with_one_line(tmp_path) -> None:
    (tmp_path / 'heavy.py').write_text(IMPORTING)
    done = run(CONSOLE.format("console_script('heavy')()"), cwd=tmp_path)
    assert done.returncode == 130
    assert done.stdout == 'imported\n'
    assert done.stderr == '-c: interrupted\n'


def test_a_second_one_does_not_disturb_the_clean_up() -> None:
    done = run(PRESSED_TWICE)
    assert (done.returncode, done.stdout) == (130, 'cleaned up')
    assert done.stderr == '-c: interrupted\n'


def test_one_after_the_clean_up_raises_again(monkeypatch) -> None:
    handler, now = InterruptOnce(), [10.0]
    monkeypatch.setattr(time, 'monotonic', lambda: now[0])
    with pytest.raises(KeyboardInterrupt):
        handler(signal.SIGINT, None)
    now[0] += 2.0
    handler(signal.SIGINT, None)
    now[0] += 2.0
    with pytest.raises(KeyboardInterrupt):
        handler(signal.SIGINT, None)


def test_one_that_is_held_acts_at_the_end_of_the_block() -> None:
    reached = []
    with pytest.raises(KeyboardInterrupt), InterruptsHeld():
        signal.raise_signal(signal.SIGINT)
        reached.append('the end')
    assert reached == ['the end']


def test_a_held_one_can_be_taken_and_then_it_is_gone() -> None:
    with InterruptsHeld():
        assert not take_held_interrupt()
        signal.raise_signal(signal.SIGINT)
        assert take_held_interrupt()
        assert not take_held_interrupt()


def test_blocks_may_be_nested() -> None:
    reached = []
    with pytest.raises(KeyboardInterrupt), InterruptsHeld():
        with InterruptsHeld():
            signal.raise_signal(signal.SIGINT)
        reached.append('the end')
    assert reached == ['the end']


def test_threads_are_started_with_interrupts_held() -> None:
    masks = []
    with InterruptsHeld():
        thread = threading.Thread(
            target=lambda: masks.append(signal.pthread_sigmask(signal.SIG_BLOCK, ()))
        )
        thread.start()
        thread.join()
    assert masks == [{signal.SIGINT}]
