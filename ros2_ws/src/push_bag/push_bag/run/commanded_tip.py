"""Commands and tip of a recorded run, for the calibration of the robot's response."""

import math
from pathlib import Path

import numpy as np
from push_core.common import InputError
from push_core.data import CommandedTip
from push_msgs.msg import ControllerState

from push_bag.run.recorded_ticks import RecordedRun, RecordedTick

_NS = 1e-9


def commanded_tip(path: Path) -> CommandedTip:
    """The last start of a bag: what was commanded, and where the tip went.

    A command counts from when the controller sent it, by the clock of the stamps, so that the
    response includes the way of the message.

    Raises:
        InputError: there is no readable bag, or it lacks commands or poses of the tip.
    """
    run = RecordedRun(path)
    ticks: list[RecordedTick] = []
    mode = ControllerState.IDLE
    for tick in run.ticks():
        if tick.mode == ControllerState.ARMED and mode != ControllerState.ARMED:
            ticks.clear()
        mode = tick.mode
        if tick.velocity is not None:
            ticks.append(tick)
    tip = run.tip_poses
    if not ticks or not tip.stamp.size:
        raise InputError(f'{path} holds no commands, or no poses of the tip')
    sent = np.array([_sent(tick) for tick in ticks])
    during = (tip.stamp >= sent[0]) & (tip.stamp <= sent[-1])
    return CommandedTip(
        path.name,
        (sent - sent[0]) * _NS,
        np.array([tick.velocity for tick in ticks]),
        (tip.stamp[during] - sent[0]) * _NS,
        tip.values[during],
    )


def _sent(tick: RecordedTick) -> int:
    """When a tick sent its command [ns]; one without poses is stamped with that time."""
    return tick.stamp + (
        0 if math.isnan(tick.exposure) else round((tick.now - tick.exposure) / _NS)
    )
