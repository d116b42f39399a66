"""Prepares models for the controller in a process of its own.

Planning anew and linearising a lap holds Python's interpreter lock for 4 ms at a time, in LAPACK's
banded solver alone. In a thread the 10 ms loop would wait for that; and with the loop's real-time
priority a second of it would use up what the kernel grants such threads, the loop included.
"""

import contextlib
import os
import pickle
import subprocess
import sys
from typing import IO

from push_core.common import PushError, RunError

from push_mpc.loop import Controller, PreparedModel
from push_mpc.plan import Plan
from push_mpc.settings import MpcSettings
from push_mpc.table import Table


class Preparation:
    """Prepares the first model itself, before which nothing moves that could be late.

    The process takes about a second to start, which the first model need not wait for.
    """

    def __init__(self, settings: MpcSettings, controller: Controller) -> None:
        """For one controller, made of these settings."""
        self._settings, self._controller = settings, controller
        self._process: subprocess.Popen[bytes] | None = None

    def prepare(self, table: Table, model_id: str) -> PreparedModel:
        """See `Controller.prepare_model`; waits for the process without the interpreter lock.

        Raises:
            PushError: the model cannot be used, or the process has ended.
        """
        if self._process is None:
            self._process = _started()
            return self._controller.prepare_model(table, model_id)
        try:
            result = self._asked(self._process, table, model_id)
        except (OSError, EOFError, pickle.UnpicklingError) as error:
            self._process = None
            raise RunError('the process that prepares models has ended') from error
        if isinstance(result, Exception):
            raise result
        return result

    def _asked(
        self, process: 'subprocess.Popen[bytes]', table: Table, model_id: str
    ) -> PreparedModel | Exception:
        assert process.stdin is not None
        assert process.stdout is not None
        _send(process.stdin, (self._settings, self._controller.plan, table, model_id))
        result: PreparedModel | Exception = pickle.load(process.stdout)
        return result

    def close(self) -> None:
        """Ends the process."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()


def _started() -> 'subprocess.Popen[bytes]':
    # in a session of its own Ctrl-C does not reach it; it ends with its input
    return subprocess.Popen(
        [sys.executable, '-m', __name__],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        start_new_session=True,
    )


def _send(stream: IO[bytes], value: object) -> None:
    pickle.dump(value, stream, protocol=5)
    stream.flush()


def main() -> None:
    """Answers requests with prepared models until the node that makes them is gone."""
    # a node with real-time priority hands it down
    os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    with contextlib.suppress(EOFError, BrokenPipeError):
        while True:
            _send(sys.stdout.buffer, _prepared(*pickle.load(sys.stdin.buffer)))


def _prepared(
    settings: MpcSettings, plan: Plan, table: Table, model_id: str
) -> PreparedModel | Exception:
    try:
        return Controller(settings, settings.slider, plan).prepare_model(table, model_id)
    except (PushError, ValueError) as error:
        return error


if __name__ == '__main__':
    main()
