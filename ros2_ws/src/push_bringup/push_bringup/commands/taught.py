"""What a recorded run has learned, for another run to go on from there."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from push_bag.file import BagReader
from push_core.common import InputError
from push_gp.learn import Learned, write_lesson
from push_gp.models import NOMINAL_DISTANCE
from push_gp.server.conversions import learned_of
from push_mpc.plan import Plan
from push_mpc.settings import MpcSettings

from push_bringup.in_process import recorded_lessons
from push_bringup.setup import CellParameters

LESSON_FILE = 'lesson.json'


def taught_by(run: Path, parameters: CellParameters, plan: Plan, inputs: Path) -> CellParameters:
    """The parameters of a run that begins with what the last lap of another one taught.

    Where the shift is of another reference it is left out, with a note on standard error.

    Args:
        run: folder or MCAP file of the other run.
        parameters: of the run.
        plan: of the run.
        inputs: folder for the file that tells gp_server.

    Raises:
        InputError: there is no readable bag, or it holds no lesson.
    """
    lessons = recorded_lessons(BagReader(run))
    if not lessons:
        raise InputError(f'{run} holds nothing that laps taught; record a run with --learn')
    learned = learned_of(lessons[-1], parameters.gp.slider, NOMINAL_DISTANCE)
    if not _fits(learned, parameters.mpc, plan):
        if learned.shift.any():
            sys.stderr.write(
                f'cell: the shift of the reference is of {learned.track} at '
                f'{1e3 * learned.speed:.4g} mm/s, so it is left out\n'
            )
        learned = replace(learned, track='', speed=0.0, shift=np.zeros((0, 2)))
    path = inputs / LESSON_FILE
    write_lesson(path, learned)
    return replace(parameters, gp=replace(parameters.gp, lesson=str(path)))


def _fits(learned: Learned, mpc: MpcSettings, plan: Plan) -> bool:
    samples = round(plan.duration / mpc.laps / plan.period)
    same = (learned.track, learned.speed) == (Path(mpc.track).stem, mpc.speed)
    return same and len(learned.shift) == samples
