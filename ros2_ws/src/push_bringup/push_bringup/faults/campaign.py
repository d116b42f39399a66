"""Runs cases, those that need the same cell one after the other in it."""

import math
import random
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from push_bag.run import RecordedRun
from push_core.common import InputError, RunError

from push_bringup.faults.bed import Bed
from push_bringup.faults.case import Case, Outcome, Verdict
from push_bringup.faults.kinds import KINDS
from push_bringup.faults.link import obstacle
from push_bringup.faults.verdict import HOST_GAP, REST_TIME, fastest, problems, rest_time

ATTEMPTS = 3
EARLIEST, LATEST = 0.3, 4.0  # [s] of the reference at which a fault begins
_AFTERWARDS = 2.0  # [s] of observation after a fault from which a run goes on
_REST = 0.6  # [s] of observation after a stop
_LONGEST = 6.0  # [s] to wait for a stop


def cases(kinds: Sequence[str], modes: Sequence[str], seeds: Iterable[int]) -> list[Case]:
    """The cases of kinds, those with the same cell beside each other."""
    made = [
        Case(kind, KINDS[kind], mode, seed)
        for kind in kinds
        for mode in modes
        if mode in KINDS[kind].modes
        for seed in seeds
    ]
    return sorted(made, key=lambda case: (case.fault.breaks, str(case.cell)))


def impossible(kinds: Iterable[str]) -> dict[str, str]:
    """Those of kinds that cannot be run on this machine, and why."""
    far = [kind for kind in kinds if KINDS[kind].far]
    why = obstacle() if far else ''
    return dict.fromkeys(far, why) if why else {}


def run_cases(chosen: Sequence[Case], done: Callable[[Verdict], None]) -> list[Verdict]:
    """Runs all cases, again while the host took the cores away; `done` is called after each.

    ROS must have been initialised.
    """
    verdicts: list[Verdict] = []
    waiting, tried = list(chosen), Counter[int]()
    while waiting:
        first = waiting[0]
        shared = [case for case in waiting if case.cell == first.cell and not case.fault.breaks]
        group = [first] if first.fault.breaks else shared
        namespace = f'faults{time.time_ns() // 1000 % 10**9}'
        for verdict in _in_one_cell(group, namespace):
            tried[id(verdict.case)] += 1
            attempts = tried[id(verdict.case)]
            disturbed = verdict.problems and verdict.host_gap > HOST_GAP
            waiting.remove(verdict.case)
            if disturbed and attempts < ATTEMPTS:
                waiting.append(verdict.case)
                continue
            verdicts.append(replace(verdict, attempts=attempts))
            done(verdicts[-1])
    return verdicts


def _in_one_cell(group: Sequence[Case], namespace: str) -> Iterator[Verdict]:
    """Runs cases in one cell; ends early where the cell cannot be used again."""
    with tempfile.TemporaryDirectory(prefix='push_faults_') as name:
        bed = Bed(group[0], Path(name), namespace)
        verdicts: list[Verdict] = []
        try:
            for case in group:
                verdict = _run(bed, case)
                verdicts.append(verdict)
                if verdict.problems or case.fault.breaks:
                    break
        finally:
            bed.close()
        yield from _as_recorded(bed.folder, verdicts)


def _run(bed: Bed, case: Case) -> Verdict:
    chance = random.Random(f'{case.kind} {case.mode} {case.seed}')
    moment = chance.uniform(EARLIEST, LATEST)
    try:
        bed.begin(moment)
    except RunError as error:
        gap = bed.observer.seen.longest_gap
        problem = (str(error),)
        return Verdict(case, moment, math.nan, 0.0, bed.reason, problem, host_gap=gap)
    bed.observer.seen.tips = bed.observer.seen.tips[-2:]
    begun = bed.now()
    lasts = case.fault.inject(bed, chance)
    _watch(bed, case)
    seen, reason = bed.observer.seen, bed.reason
    return Verdict(
        case,
        moment,
        rest_time(seen, begun),
        fastest(seen),
        reason,
        tuple(problems(case, seen, begun, lasts, reason)),
        host_gap=seen.longest_gap,
    )


def _watch(bed: Bed, case: Case) -> None:
    """Observes until it can be judged."""
    if case.fault.outcome == Outcome.CONTINUES:
        begun = bed.now()
        bed.wait(lambda: bed.ended or bed.now() - begun > 1e9 * _AFTERWARDS, 4.0 * _AFTERWARDS)
        return
    if case.fault.outcome == Outcome.STOPS:
        bed.wait(lambda: bed.ended, _LONGEST)
    bed.spin(_REST)


def _as_recorded(folder: Path, verdicts: Sequence[Verdict]) -> Iterator[Verdict]:
    """The verdicts; a stop whose reason is not in the bag is a problem."""
    try:
        recorded = {tick.stop_reason for tick in RecordedRun(folder).ticks()}
    except InputError as error:
        recorded = {f'no bag: {error}'}
    for verdict in verdicts:
        stops = verdict.case.fault.outcome == Outcome.STOPS
        kept = verdict.reason in recorded or verdict.case.fault.unrecorded
        complaints = ('the reason is not in the bag',) if stops and not kept else ()
        yield replace(verdict, problems=verdict.problems + complaints)


def summary(verdicts: Sequence[Verdict]) -> dict[str, object]:
    """The results as one object for JSON."""
    by_fault: dict[str, dict[str, object]] = {}
    for kind in dict.fromkeys(verdict.case.kind for verdict in verdicts):
        rows = [verdict for verdict in verdicts if verdict.case.kind == kind]
        rests = [row.rest for row in rows if row.rest == row.rest]
        stops = rows[0].case.fault.outcome in (Outcome.STOPS, Outcome.RESTS)
        by_fault[kind] = {
            'text': rows[0].case.fault.text,
            'expected': rows[0].case.fault.outcome.value,
            'cases': len(rows),
            'as_expected': sum(not row.problems for row in rows),
            'again': sum(row.attempts - 1 for row in rows),
            'longest_rest_s': max(rests, default=None) if stops else None,
            'allowed_rest_s': rows[0].case.fault.detection + REST_TIME if stops else None,
            'reasons': sorted({row.reason for row in rows if row.reason}),
            'fastest_m_s': max(row.fastest for row in rows),
        }
    return {
        'cases': len(verdicts),
        'unexplained': [row.as_json() for row in verdicts if row.problems],
        'by_fault': by_fault,
    }
