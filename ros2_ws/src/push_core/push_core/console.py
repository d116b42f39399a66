"""Console scripts: what holds before the first heavy import of a command or node.

Extension modules turn an interrupt of their import into errors of their own, so Ctrl-C waits for
the end of the imports; `run_command` and `run_node` take it then.
"""

import os
import signal
import sys
from collections.abc import Callable
from importlib import import_module

from push_core.middleware import set_missing_middleware_aside


def console_script(module: str) -> Callable[[], int]:
    """The console script of a command or node.

    Args:
        module: full name of the module whose `main` it runs.
    """

    def main() -> int:
        hold_interrupts()
        occupy_standard_streams()
        print_on_any_terminal()
        set_missing_middleware_aside()
        try:
            return int(import_module(module).main())
        finally:
            # the work is done: nothing is left that Ctrl-C could end
            hold_interrupts()

    return main


def hold_interrupts() -> None:
    """From here on, Ctrl-C does not reach this thread and those that it starts."""
    signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT,))


def occupy_standard_streams() -> None:
    """Opens streams that the caller has closed, or the next opened file would take their place."""
    while (number := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(number)
    if sys.stderr is None:
        sys.stderr = open(2, 'w', encoding='utf-8')  # noqa: SIM115


def print_on_any_terminal() -> None:
    """Lets a character that the terminal lacks be printed as its code instead of failing."""
    for stream in (sys.stdout, sys.stderr):
        if stream is not None and stream.errors == 'strict':
            stream.reconfigure(errors='backslashreplace')  # type: ignore[union-attr]
