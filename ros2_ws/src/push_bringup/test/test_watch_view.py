"""The view of `cell --watch`, drawn for real messages."""

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from push_bringup.commands.cell import main as cell
from push_bringup.graph.watch_view import run_table, status_table
from push_core.physics import LIMIT_NAMES
from push_mpc.loop.modes import Mode
from push_msgs.msg import ControllerState, NominalTrajectory
from rich.console import Console


def drawn(table) -> str:
    console = Console(width=120, record=True, file=open('/dev/null', 'w'))  # noqa: SIM115, PTH123
    console.print(table)
    return console.export_text()


@pytest.fixture
def plan() -> NominalTrajectory:
    times = np.linspace(0.0, 10.0, 101)
    return NominalTrajectory(
        time=times.tolist(), x=(0.08 * times).tolist(), y=np.zeros(101).tolist()
    )


def test_it_shows_mode_progress_error_and_limits(plan) -> None:
    state = ControllerState(mode=int(Mode.TRACKING), reference_time=5.0, limited=2 | 8)
    state.state = np.array([0.4, 0.003, 0.0, 0.002])
    state.input = np.array([0.08, 0.0])
    text = drawn(run_table(state, plan))
    for part in ('TRACKING', '5.0 of 10.0 s', '3.00 mm', 'p_y 2.0 mm', 'v_n 80'):
        assert part in text
    assert f'limited by {LIMIT_NAMES[2]}, {LIMIT_NAMES[8]}' in text


def test_it_shows_a_run_before_its_reference_and_the_reason_of_a_stop(plan) -> None:
    state = ControllerState(mode=int(Mode.STOPPED), reference_time=-np.inf, stop_reason='no pose')
    state.state = state.predicted = np.full(4, np.nan)
    text = drawn(run_table(state, plan))
    assert '0.0 of 10.0 s' in text
    assert 'no pose' in text


def test_it_shows_the_status_of_each_node() -> None:
    values = [KeyValue(key='rate_hz', value='99.8'), KeyValue(key='table', value='37 x 61')]
    slow = DiagnosticStatus(name='/mpc_node: control', level=DiagnosticStatus.WARN)
    slow.message, slow.values = 'a tick took 6.0 ms', values
    text = drawn(status_table({slow.name: slow}))
    assert '/mpc_node: control' in text
    assert 'a tick took 6.0 ms' in text
    assert 'rate_hz 99.8' in text
    assert '37 x 61' not in text


def test_it_is_refused_where_there_are_no_nodes(capsys) -> None:
    assert cell(['--watch', '--mode', 'inprocess']) == 2
    assert '--watch has no effect' in capsys.readouterr().err
