"""A host that fails the nodes: a full disk, busy cores, lost commands."""

import os
import random
import resource
import subprocess
import sys

from push_bringup.faults.bed import Bed
from push_bringup.faults.case import Fault, Outcome
from push_bringup.faults.injections import BOTH, RECORDER_SILENCE

_LONG = 2.0  # [s]


def _full_disk(bed: Bed, _random: random.Random) -> float:
    """Writes of the recorder fail from here on, as on a full disk."""
    size = max(path.stat().st_size for path in bed.folder.glob('*.mcap'))
    limit = (size, resource.getrlimit(resource.RLIMIT_FSIZE)[1])
    resource.prlimit(bed.processes.pid('recorder'), resource.RLIMIT_FSIZE, limit)
    return 0.0


def _hogged(bed: Bed, _random: random.Random) -> float:
    hogs = [
        subprocess.Popen([sys.executable, '-c', 'while True: pass'])
        for _ in range(2 * (os.cpu_count() or 1))
    ]
    bed.spin(_LONG)
    for hog in hogs:
        hog.kill()
        hog.wait()
    return _LONG


def _elapsed(bed: Bed, _random: random.Random) -> float:
    """A time passes: the fault is a parameter of the cell."""
    bed.spin(_LONG)
    return _LONG


HOST_FAULTS: dict[str, Fault] = {
    'disk_full': Fault(
        'the disk of the recording is full',
        Outcome.STOPS,
        _full_disk,
        'the recorder does not record',
        RECORDER_SILENCE,
        breaks=True,
        unrecorded=True,
    ),
    'cores_hogged': Fault('two processes on each core for 2 s', Outcome.CONTINUES, _hogged),
    'commands_lost': Fault(
        'one command in ten is lost',
        Outcome.CONTINUES,
        _elapsed,
        modes=BOTH,
        parameters={'command_loss': 0.1},
    ),
}
