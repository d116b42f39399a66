"""What /diagnostics says of the loop."""

import math

import numpy as np
import pytest
from push_core.common import InputError
from push_core.physics.safety import ACCELERATION, SPEED
from push_mpc.loop.modes import Mode
from push_mpc.loop.tick import Tick
from push_mpc.node.loop_health import LoopHealth, stop_finding
from push_mpc.settings.diagnostics_settings import DiagnosticsSettings
from push_node.diagnostics import ERROR, OK, WARN, worst

THRESHOLDS = DiagnosticsSettings()


@pytest.fixture
def health() -> LoopHealth:
    return LoopHealth(0.01)


def told(health, seconds=1.0, **totals):
    findings, values = health.take(seconds, totals, THRESHOLDS)
    return worst(findings, 'tracking'), values


def second(health, mode=Mode.TRACKING, tick_ms=1.0, count=100, **facts) -> None:
    for _ in range(count):
        health.note(Tick(mode, np.zeros(2), **facts), tick_ms)


def test_a_quiet_second_is_ok_with_its_figures(health) -> None:
    second(health, solve_ms=0.3)
    verdict, values = told(health)
    assert verdict == (OK, 'tracking')
    assert (values['rate_hz'], values['solve_ms_max'], values['tick_ms_max']) == (
        *('100.0', '0.30', '1.00'),
    )


@pytest.mark.parametrize(('tick_ms', 'level'), [(4.9, OK), (5.1, WARN), (10.1, ERROR)])
def test_a_slow_tick_is_a_warning_and_a_late_one_an_error(health, tick_ms, level) -> None:
    second(health)
    second(health, tick_ms=tick_ms, count=1)
    verdict, values = told(health)
    assert verdict[0] == level
    assert values['late_ticks'] == str(int(tick_ms > 10.0))


@pytest.mark.parametrize(('count', 'level'), [(100, OK), (90, WARN), (40, ERROR)])
def test_a_low_rate_counts_in_a_run_only(health, count, level) -> None:
    second(health, count=count)
    assert told(health)[0][0] == level
    second(health, Mode.IDLE, count=count)
    assert told(health)[0][0] == OK
    second(health, count=count)
    assert told(health, math.inf)[0][0] == OK


def test_holds_are_a_warning(health) -> None:
    second(health, Mode.HOLDING, count=3)
    second(health, count=97)
    assert told(health)[0] == (WARN, 'no fresh pose for 3 ticks')


def test_what_is_new_is_a_warning_once(health) -> None:
    assert told(health, refused_old=2)[0] == (WARN, 'refused_old 2')
    assert told(health, refused_old=2)[0] == (OK, 'tracking')
    verdict, values = told(health, refused_old=5, solver_failures=1)
    assert verdict == (WARN, 'refused_old 3; solver_failures 1')
    assert values['refused_old'] == '5'


def test_each_limit_has_its_count(health) -> None:
    second(health, count=2, limited=SPEED | ACCELERATION)
    second(health, count=3, limited=SPEED)
    values = told(health)[1]
    assert (values['limited_speed'], values['limited_acceleration']) == ('5', '2')
    assert values['limited_workspace'] == '0'


def test_a_stop_that_was_asked_for_is_no_error() -> None:
    assert stop_finding('stopped on request', 'stopped on request')[0] == WARN
    assert stop_finding('no pose for 1500 ms', 'stopped on request')[0] == ERROR


def test_a_warning_must_come_before_the_error() -> None:
    with pytest.raises(InputError, match='a warning must come before the error'):
        DiagnosticsSettings(tick_warn=0.02)
