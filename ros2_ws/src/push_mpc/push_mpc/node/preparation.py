"""Prepares models for the controller in a separate process.

Replanning a lap holds Python's interpreter lock for 4 ms at a time, in LAPACK's banded solver. In
a thread of the node it would delay the 10 ms loop. It would also run for a second with the loop's
real-time priority, and so use up the time that the kernel grants to real-time threads.
"""

import contextlib
import pickle
import subprocess
import sys
from typing import IO

from push_core.common import PushError, RunError
from push_node.realtime import leave_realtime

from push_mpc.loop import Controller, PreparedModel
from push_mpc.plan import Lesson, Plan
from push_mpc.settings import MpcSettings
from push_mpc.table import Table


class Preparation:
    """Prepares the first model in the calling thread, later ones in a separate process.

    Before the first model nothing moves, so there is no loop to delay, and the model need not wait
    the second that the process takes to start.
    """

    def __init__(self, settings: MpcSettings, controller: Controller) -> None:
        """Prepares models for one controller and the settings that it was made with."""
        self._settings, self._controller = settings, controller
        self._process: subprocess.Popen[bytes] | None = None

    def prepare(self, table: Table, model_id: str, lesson: Lesson | None = None) -> PreparedModel:
        """See `Controller.prepare_model`; waits for the process without the interpreter lock.

        Raises:
            PushError: the model cannot be used, or the process has ended.
        """
        if self._process is None:
            self._process = _started()
            return self._controller.prepare_model(table, model_id, lesson)
        try:
            result = self._asked(self._process, table, model_id, lesson)
        except (OSError, EOFError, pickle.UnpicklingError) as error:
            self._process = None
            raise RunError('the process that prepares models has ended') from error
        if isinstance(result, Exception):
            raise result
        return result

    def _asked(
        self,
        process: 'subprocess.Popen[bytes]',
        *model: Table | str | Lesson | None,
    ) -> PreparedModel | Exception:
        assert process.stdin is not None
        assert process.stdout is not None
        _send(process.stdin, (self._settings, self._controller.track_plan, *model))
        result: PreparedModel | Exception = pickle.load(process.stdout)
        return result

    def close(self) -> None:
        """Ends the process."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()


def _started() -> 'subprocess.Popen[bytes]':
    # a new session, so that Ctrl-C does not reach it; it ends when its standard input closes
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
    """Prepares a model for each request on standard input, until that closes."""
    # the process inherits the node's real-time priority and core
    leave_realtime()
    with contextlib.suppress(EOFError, BrokenPipeError):
        while True:
            _send(sys.stdout.buffer, _prepared(*pickle.load(sys.stdin.buffer)))


def _prepared(
    settings: MpcSettings, plan: Plan, table: Table, model_id: str, lesson: Lesson | None
) -> PreparedModel | Exception:
    try:
        controller = Controller(settings, settings.slider, plan)
        return controller.prepare_model(table, model_id, lesson)
    except (PushError, ValueError) as error:
        return error


if __name__ == '__main__':
    main()
