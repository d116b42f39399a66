"""What laps have taught as a JSON file, for a run that goes on from there."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
from push_core.common import InputError, json_text
from push_core.physics import Slider

from push_gp.learn.identification import Identified
from push_gp.learn.lap_learner import Learned
from push_gp.models import NOMINAL_DISTANCE, SmoothCone


def write_lesson(path: Path, learned: Learned) -> None:
    """Writes what was learned; numbers keep every bit."""
    slider, known = learned.identified.model.slider, learned.identified
    values = {
        'friction': slider.friction_pusher,
        'support_radius_m': slider.support_radius,
        'covariance': known.covariance.tolist(),
        'pushes': known.pushes,
        'track': learned.track,
        'speed_m_s': learned.speed,
        'shift_m': learned.shift.tolist(),
    }
    path.write_text(json_text(values), encoding='utf-8')


def read_lesson(path: Path, nominal: Slider) -> Learned:
    """What was learned; the geometry is that of the nominal slider.

    Raises:
        InputError: the file is no lesson, or its numbers cannot be.
    """
    try:
        values = json.loads(path.read_text(encoding='utf-8'))
        slider = replace(
            nominal,
            friction_pusher=float(values['friction']),
            support_radius=float(values['support_radius_m']),
        )
        covariance = np.array(values['covariance'], dtype=float).reshape(2, 2)
        shift = np.array(values['shift_m'], dtype=float).reshape(-1, 2)
        track, speed, pushes = values['track'], values['speed_m_s'], int(values['pushes'])
    except (OSError, UnicodeDecodeError, KeyError, TypeError, ValueError, InputError) as error:
        raise InputError(f'{path} is not what laps have taught: {error}') from error
    if not (np.isfinite(covariance).all() and np.isfinite(shift).all()):
        raise InputError(f'{path} is not what laps have taught: it has numbers that are none')
    known = Identified(SmoothCone(slider, NOMINAL_DISTANCE), covariance, pushes)
    return Learned(known, str(track), float(speed), shift)
