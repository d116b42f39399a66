"""`cell --watch`: a view of the running cell in the terminal, which updates in place."""

import math
import time
from collections.abc import Callable
from types import TracebackType

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from push_core.physics import LIMIT_NAMES
from push_mpc.loop import Mode
from push_msgs.msg import ControllerState, NominalTrajectory
from push_node import interface
from push_node.diagnostics import ERROR, OK, WARN
from rclpy.node import Node
from rich.console import Console, Group
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

PERIOD = 0.2  # [s] between two updates
COLOURS = {OK: 'green', WARN: 'yellow', ERROR: 'red'}
SHOWN = ('rate_hz', 'tick_ms_max', 'solve_ms_max', 'pose_age_ms', 'late_frames')
"""Values of /diagnostics beside the message, where a node has them."""


class WatchView:
    """Shows mode, progress, error and the status of each node."""

    def __init__(self, node: Node, console: Console | None = None) -> None:
        """Listens to the cell in the namespace of a node.

        Args:
            node: that listens.
            console: to show it on; default: the terminal, on standard error.
        """
        self._namespace = node.get_namespace()
        self._live = Live(console=console or Console(stderr=True), auto_refresh=False)
        self._statuses: dict[str, DiagnosticStatus] = {}
        self._shown = -math.inf
        interface.DIAGNOSTICS.subscription(node, self._on_diagnostics)

    def __enter__(self) -> Callable[[ControllerState | None, NominalTrajectory], None]:
        """Starts the view; returns what updates it."""
        self._live.__enter__()
        return self._update

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._live.__exit__(kind, error, trace)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            if status.hardware_id == self._namespace:
                self._statuses[status.name] = status

    def _update(self, state: ControllerState | None, plan: NominalTrajectory) -> None:
        if time.monotonic() - self._shown < PERIOD or state is None:
            return
        self._shown = time.monotonic()
        parts = (run_table(state, plan), status_table(self._statuses))
        self._live.update(Group(*parts), refresh=True)


def run_table(state: ControllerState, plan: NominalTrajectory) -> Table:
    """What the controller does."""
    table = Table.grid(padding=(0, 2))
    total, done = plan.time[-1], min(max(state.reference_time, 0.0), plan.time[-1])
    stopped = state.mode in (Mode.STOPPED, Mode.FAULT)
    mode = Text(Mode(state.mode).name, style='red' if stopped else 'bold')
    table.add_row('mode', mode, state.stop_reason)
    bar = ProgressBar(total=total, completed=done, width=40)
    table.add_row('reference', bar, f'{done:.1f} of {total:.1f} s')
    error = math.hypot(
        *(
            np.interp(state.reference_time, plan.time, line) - place
            for line, place in zip((plan.x, plan.y), state.state[:2], strict=True)
        )
    )
    table.add_row('error', f'{1e3 * error:.2f} mm', f'p_y {1e3 * state.state[3]:.1f} mm')
    v_n, v_t = 1e3 * state.input
    table.add_row('input', f'v_n {v_n:.0f}, v_t {v_t:.0f} mm/s', limits_text(state.limited))
    table.add_row('solve', f'{state.solve_ms:.2f} ms', f'tick {state.tick_ms:.2f} ms')
    return table


def limits_text(limited: int) -> str:
    """Names of the limits that changed the command."""
    names = [name for bit, name in LIMIT_NAMES.items() if limited & bit]
    return f'limited by {", ".join(names)}' if names else ''


def status_table(statuses: dict[str, DiagnosticStatus]) -> Table:
    """The status of each node, the worst in colour."""
    table = Table('node', 'status', 'figures', box=None)
    for name, status in sorted(statuses.items()):
        figures = [f'{pair.key} {pair.value}' for pair in status.values if pair.key in SHOWN]
        message = Text(status.message, style=COLOURS.get(status.level, 'red'))
        table.add_row(name, message, ', '.join(figures))
    return table
