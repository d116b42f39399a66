"""A validation as figures: the JSON of `validate`, on which scripts rely."""

from typing import Any

import numpy as np
from push_core.data import LongPushes
from push_core.geometry import Array, wrap_angle
from push_core.physics import ActuatorSettings

from push_sim.measured import RobotRun, rms_coordinate, tip_gap
from push_sim.validation.comparison import (
    LongComparison,
    RunComparison,
    ShortComparison,
    Validation,
)


def as_json(found: Validation) -> dict[str, Any]:
    """The whole object; a part without files is null or an empty list."""
    return {
        'pushes_4mm': _short(found.short) if found.short else None,
        'pushes_50mm': [_long(comparison) for comparison in found.long],
        'robot_runs': [_run(comparison) for comparison in found.runs],
        'missing': list(found.missing),
    }


def _short(compared: ShortComparison) -> dict[str, Any]:
    ellipsoid = compared.ellipsoid_accuracy.as_json()
    return {**compared.accuracy.as_json(), 'limit_surface': ellipsoid}


def _long(compared: LongComparison) -> dict[str, Any]:
    return {
        'file': compared.file,
        **_ends(compared.pushes, compared.simulated),
        'limit_surface': _ends(compared.pushes, compared.ellipsoid),
    }


def _ends(pushes: LongPushes, predicted: Array) -> dict[str, Any]:
    errors = pushes.errors(predicted)
    everywhere = np.ones(len(pushes), dtype=np.bool_)
    return {'on_face': errors.of(pushes.on_face), 'all': errors.of(everywhere)}


def _run(compared: RunComparison) -> dict[str, Any]:
    run = compared.run
    return {
        'file': run.name,
        **_tip(run, compared.actuator),
        **_slider(compared, compared.simulated),
        'windows': len(compared.simulated),
        'rows': len(run.time),
        'rows_followed': run.following,
        'identified': _tip(run, compared.identified),
        'limit_surface': _slider(compared, compared.ellipsoid),
    }


def _tip(run: RobotRun, actuator: ActuatorSettings) -> dict[str, float]:
    rms = rms_coordinate(tip_gap(run, actuator))
    return {
        'lag_s': actuator.lag,
        'dead_time_s': actuator.dead_time,
        'tip_rms_mm': rms * 1e3,
        'tip_distance_rms_mm': rms * np.sqrt(2.0) * 1e3,
    }


def _slider(compared: RunComparison, predicted: Array) -> dict[str, float]:
    gap = predicted - compared.windows.end
    distance, angle = (
        np.linalg.norm(gap[:, :2]),
        np.linalg.norm([wrap_angle(turn) for turn in gap[:, 2].tolist()]),
    )
    windows = np.sqrt(len(gap))
    return {
        'slider_rms_mm': float(distance / windows) * 1e3,
        'slider_rms_deg': float(np.degrees(angle / windows)),
    }
