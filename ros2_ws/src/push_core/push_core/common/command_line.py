"""Argument parsing, error messages and exit status of every command."""

import argparse
import os
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import NoReturn

from push_core.common.errors import InputError, PushError
from push_core.common.interrupts import INTERRUPTED, InterruptOnce, release_interrupts


class Parser(argparse.ArgumentParser):
    """An argument parser with `--debug` and one-line errors of status 2."""

    def __init__(self, description: str, epilog: str = '') -> None:
        super().__init__(
            description=description,
            epilog=epilog,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        self.add_argument('--debug', action='store_true', help='show the traceback of an error')

    def error(self, message: str) -> NoReturn:
        """One line on standard error, status 2."""
        self.exit(2, f'{self.prog}: {message}; see {self.prog} --help\n')


def run_command(
    parser: Parser,
    work: Callable[[argparse.Namespace], int | None],
    argv: Sequence[str] | None = None,
) -> int:
    """Runs a command: parses, works, prints an error as one line. SIGTERM acts like Ctrl-C.

    Args:
        parser: describes the command line.
        work: does the work; returns the exit status, None for 0.
        argv: arguments without the name of the command; default: those of the process.

    Returns:
        Exit status: 0 done, 1 the run or check failed, 2 the command was wrong, 130 interrupted.
    """
    with _signals_taken():
        return _run(parser, work, argv)


def _run(
    parser: Parser,
    work: Callable[[argparse.Namespace], int | None],
    argv: Sequence[str] | None,
) -> int:
    debug = False
    try:
        release_interrupts()
        arguments = parser.parse_args(argv)
        debug = arguments.debug
        _check_output()
        status = work(arguments) or 0
        # a full disk or a reader that went away shows now, not at the end of the interpreter
        sys.stdout.flush()
        return status
    except BrokenPipeError:
        # the reader (head, less) went away: nobody is left to tell
        _discard_output()
        return 128 + signal.SIGPIPE
    except (PushError, OSError) as error:
        if debug:
            traceback.print_exc()
        print(f'{parser.prog}: {describe(error)}', file=sys.stderr)  # noqa: T201
        _flush_or_discard()
        return error.status if isinstance(error, PushError) else 1
    except KeyboardInterrupt:
        print(f'{parser.prog}: interrupted', file=sys.stderr)  # noqa: T201
        return INTERRUPTED


@contextmanager
def _signals_taken() -> Iterator[None]:
    """Lets SIGINT and SIGTERM raise KeyboardInterrupt; restores the handlers at the end."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    handler, before = InterruptOnce(), {}
    for number in (signal.SIGINT, signal.SIGTERM):
        # what runs in the background of a shell ignores SIGINT
        if signal.getsignal(number) is not signal.SIG_IGN:
            before[number] = signal.signal(number, handler)
    try:
        yield
    finally:
        for number, old in before.items():
            signal.signal(number, old)


def _check_output() -> None:
    if sys.stdout is None:
        raise InputError('standard output is closed; add > /dev/null if it is not needed')


def _flush_or_discard() -> None:
    try:
        if sys.stdout is not None:
            sys.stdout.flush()
    except OSError:
        _discard_output()


def _discard_output() -> None:
    """Spares the interpreter, which flushes at its end, a second error."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def describe(error: BaseException) -> str:
    """The message of an error in one line, also of an error of the operating system."""
    if isinstance(error, OSError) and error.strerror:
        return f'{error.filename}: {error.strerror}' if error.filename else error.strerror
    return ' '.join(str(error).split())
