"""Nodes that are killed, or do not run for a time."""

import random
import signal

from push_bringup.faults.bed import Bed
from push_bringup.faults.case import Fault, Outcome
from push_bringup.faults.injections import RECORDER_SILENCE, WATCHDOG, Inject
from push_bringup.graph import MODULES

_GONE = 'was killed by signal 9'
_SILENT = 'no report from the recorder'


def _signal(name: str, number: int) -> Inject:
    def inject(bed: Bed, _random: random.Random) -> float:
        bed.signal(name, number)
        return 0.0

    return inject


def _freeze(names: tuple[str, ...], duration: float) -> Inject:
    """SIGSTOP for a time [s]."""

    def inject(bed: Bed, _random: random.Random) -> float:
        for name in names:
            bed.signal(name, signal.SIGSTOP)
        bed.spin(duration)
        for name in names:
            bed.signal(name, signal.SIGCONT)
        return duration

    return inject


def _killed(
    name: str, outcome: Outcome, reason: str = _GONE, detection: float = 0.0
) -> dict[str, Fault]:
    text, unrecorded = f'{name} is killed', name == 'recorder'
    inject = _signal(name, signal.SIGKILL)
    fault = Fault(text, outcome, inject, reason, detection, breaks=True, unrecorded=unrecorded)
    return {f'kill_{name}': fault}


_KILLS = {
    **_killed('sim_node', Outcome.STOPS, 'no pose for'),
    **_killed('gp_server', Outcome.CONTINUES),
    **_killed('mpc_node', Outcome.RESTS, detection=WATCHDOG),
    **_killed('recorder', Outcome.STOPS, _SILENT, RECORDER_SILENCE),
    'kill_recorder_unrequired': Fault(
        'the recorder is killed, and none is required',
        Outcome.CONTINUES,
        _signal('recorder', signal.SIGKILL),
        _GONE,
        parameters={'require_recorder': False},
        breaks=True,
    ),
}
_FREEZES = {
    f'freeze_{name}': Fault(
        f'{name} does not run for 200 ms', Outcome.CONTINUES, _freeze((name,), 0.2)
    )
    for name in MODULES
}
_HALTS = {
    'halt_mpc_node': Fault(
        'mpc_node does not run for 3 s',
        Outcome.RESTS,
        _signal('mpc_node', signal.SIGSTOP),
        detection=WATCHDOG,
        breaks=True,
    ),
    'halt_recorder': Fault(
        'the recorder does not run any more',
        Outcome.STOPS,
        _signal('recorder', signal.SIGSTOP),
        _SILENT,
        RECORDER_SILENCE,
        breaks=True,
        unrecorded=True,
    ),
}
PROCESS_FAULTS: dict[str, Fault] = {
    **_KILLS,
    **_FREEZES,
    'freeze_all': Fault('no node runs for 1 s', Outcome.CONTINUES, _freeze(tuple(MODULES), 1.0)),
    **_HALTS,
}
