"""Argument parsing, error messages and exit status of every command."""

import argparse
import os
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Sequence
from typing import NoReturn

from push_core.common.errors import PushError

INTERRUPTED = 130


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
    arguments = parser.parse_args(argv)
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        return work(arguments) or 0
    except BrokenPipeError:
        # the reader (head, less) has closed the pipe
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 128 + signal.SIGPIPE
    except (PushError, OSError) as error:
        if arguments.debug:
            traceback.print_exc()
        print(f'{parser.prog}: {describe(error)}', file=sys.stderr)  # noqa: T201
        return error.status if isinstance(error, PushError) else 1
    except KeyboardInterrupt:
        print(f'{parser.prog}: interrupted', file=sys.stderr)  # noqa: T201
        return INTERRUPTED


def describe(error: BaseException) -> str:
    """The message of an error in one line, also of an error of the operating system."""
    if isinstance(error, OSError) and error.strerror:
        return f'{error.filename}: {error.strerror}' if error.filename else error.strerror
    return ' '.join(str(error).split())
