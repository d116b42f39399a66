"""The verdict on a fault: it must be able to say no."""

import math

import numpy as np
import pytest
from push_bringup.commands.faults_page import write_page
from push_bringup.faults.campaign import cases, impossible, summary
from push_bringup.faults.case import Case, Fault, Outcome, Verdict
from push_bringup.faults.kinds import KINDS
from push_bringup.faults.observer import Seen
from push_bringup.faults.sick import FAULT_FILE
from push_bringup.faults.sick.controller import SickSteering
from push_bringup.faults.verdict import problems, rest_time
from push_mpc.loop import Mode

TICK = 10_000_000  # [ns]
BEGUN = 100 * TICK


def seen_of(speed, mode=Mode.TRACKING, distance=0.0, reason='') -> Seen:
    """A second before the fault and three after it; speed, mode and distance by time since it."""
    seen = Seen(reasons=[reason] if reason else [])
    x = 0.0
    for tick in range(400):
        since = 0.01 * tick - 1.0
        now = speed(since) if callable(speed) else speed
        x += 0.01 * now
        seen.tips.append((tick * TICK, x, 0.0))
        seen.commands.append((tick * TICK, now, 0.0))
        seen.states.append((tick * TICK, mode if since > 0 else Mode.TRACKING, since, distance))
    return seen


def found(outcome, seen, given='', **facts) -> list[str]:
    fault = Fault('', outcome, lambda *_: 0.0, **facts)
    return problems(Case('kind', fault, 'realtime', 0), seen, BEGUN, 0.0, given)


def braking(rest: float):
    return lambda since: 0.08 if since < rest else 0.0


def test_the_time_to_rest_is_that_of_the_last_motion() -> None:
    assert rest_time(seen_of(braking(0.2)), BEGUN) == pytest.approx(0.2, abs=0.011)
    assert rest_time(seen_of(0.0), BEGUN) == 0.0
    assert math.isnan(rest_time(seen_of(0.08), BEGUN))
    again = seen_of(lambda since: 0.08 if since < 0.1 or since > 1.0 else 0.0)
    assert math.isnan(rest_time(again, BEGUN))


def test_a_stop_must_come_in_time_and_with_its_reason() -> None:
    stopped = seen_of(braking(0.2), Mode.STOPPED, reason='no pose for 500 ms')
    assert found(Outcome.STOPS, stopped, 'no pose for 500 ms', reason='no pose') == []
    assert found(Outcome.STOPS, stopped, 'another', reason='no pose') != []
    late = seen_of(braking(0.31), Mode.STOPPED)
    assert 'at rest after 0.3' in found(Outcome.STOPS, late)[0]
    assert found(Outcome.STOPS, late, detection=0.1) == []
    assert found(Outcome.STOPS, seen_of(braking(0.2), Mode.HOLDING)) == ['it did not stop']


def test_going_on_means_tracking_at_the_end_near_the_reference() -> None:
    assert found(Outcome.CONTINUES, seen_of(0.08)) == []
    assert found(Outcome.CONTINUES, seen_of(0.08, Mode.STOPPED)) == ['it stopped']
    assert found(Outcome.CONTINUES, seen_of(0.0, Mode.HOLDING)) == [
        'it does not track at the end: HOLDING'
    ]
    away = found(Outcome.CONTINUES, seen_of(0.08, distance=0.02))
    assert away == ['20.0 mm from the reference']


@pytest.mark.parametrize(
    ('speed', 'problem'), [(0.3, 'too fast'), (math.nan, 'not finite'), (0.3, 'the tip moves')]
)
def test_limits_hold_whatever_the_outcome(speed, problem) -> None:
    assert any(problem in each for each in found(Outcome.RESTS, seen_of(speed)))


def test_the_workspace_holds_too() -> None:
    seen = seen_of(0.0)
    seen.tips = [(stamp, 0.61, 0.0) for stamp, _, _ in seen.tips]
    assert 'the tip leaves the workspace' in found(Outcome.RESTS, seen)


def test_cases_are_those_of_the_modes_in_which_the_fault_can_happen() -> None:
    chosen = cases(['stop', 'solver_raises'], ['realtime', 'lockstep'], range(2))
    assert len(chosen) == 2 + 4
    assert len({(case.kind, case.mode, case.seed) for case in chosen}) == len(chosen)


def test_what_needs_a_network_is_left_out_with_the_reason_where_none_can_be_made(
    monkeypatch,
) -> None:
    monkeypatch.setattr('os.geteuid', lambda: 1000)
    assert impossible(['stop', 'network_3s']) == {'network_3s': 'network namespaces need root'}
    assert impossible(['stop']) == {}


def test_the_summary_names_what_is_not_as_expected() -> None:
    case = cases(['stop'], ['realtime'], [0])[0]
    good = Verdict(case, 1.0, 0.2, 0.08, 'stopped on request', ())
    bad = Verdict(case, 1.0, np.nan, 0.08, '', ('it did not stop',), attempts=3)
    told = summary([good, bad])
    assert told['cases'] == 2
    assert [row['problems'] for row in told['unexplained']] == [['it did not stop']]
    assert told['by_fault']['stop']['as_expected'] == 1
    assert told['by_fault']['stop']['again'] == 2
    assert told['by_fault']['stop']['reasons'] == ['stopped on request']
    assert told['by_fault']['stop']['allowed_rest_s'] == pytest.approx(0.25)


@pytest.mark.parametrize('problem', ['', 'it did not stop'])
def test_the_page_explains_its_columns_and_lists_what_is_not_as_expected(
    tmp_path, problem
) -> None:
    case = cases(['stop'], ['realtime'], [3])[0]
    verdicts = [Verdict(case, 1.0, 0.2, 0.08, '', (problem,) if problem else ())]
    write_page(tmp_path / 'faults.html', verdicts, summary(verdicts))
    shown = (tmp_path / 'faults.html').read_text()
    assert '<td>0.20 s</td><td>0.25 s</td>' in shown
    assert case.fault.text in shown
    assert 'until the tip is slower than 5 mm/s' in shown
    assert (f'<td>{problem}</td>' in shown) == bool(problem)
    assert ('Every case led to what it must' in shown) != bool(problem)


@pytest.mark.parametrize('kind', KINDS)
def test_every_fault_says_what_happens_and_why_a_run_stops(kind) -> None:
    fault = KINDS[kind]
    assert fault.text
    assert fault.outcome != Outcome.STOPS or fault.reason


class Healthy:
    """A steering that solves everything."""

    def take(self, slider):
        self.slider = slider

    def solve(self):
        return 'solved'


def test_a_solver_stays_sick_when_a_model_is_taken(monkeypatch, tmp_path) -> None:
    (tmp_path / 'fault').write_text('raises')
    monkeypatch.setenv(FAULT_FILE, str(tmp_path / 'fault'))
    sick = SickSteering(Healthy())
    sick.take('another')
    with pytest.raises(ArithmeticError):
        sick.solve()
