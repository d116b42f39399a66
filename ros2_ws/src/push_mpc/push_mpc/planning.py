"""From the node's parameters to the plan that it tracks."""

import numpy as np
from push_core import tracks
from push_core.errors import InputError
from push_core.safety import SafetyLimits

from push_mpc.node_settings import MpcSettings
from push_mpc.nominal import Plan, flat_plan

_PLACES = 1000
_MARGIN = 0.5  # [s] beyond horizon and delay


def planned(settings: MpcSettings) -> Plan:
    """The plan along the track that the settings name.

    Raises:
        InputError: an unknown track, one that cannot be pushed or leaves the workspace, or too
            high a speed.
    """
    fastest = min(settings.limits.speed, settings.actuator.speed_limit)
    if settings.speed > fastest:
        raise InputError(
            f'parameter speed is {settings.speed:g}, must be between 0.001 and {fastest:g} m/s, '
            'the limit of the pusher'
        )
    delay = settings.actuator.dead_time + settings.actuator.lag
    overrun = settings.horizon_length / settings.speed + delay + _MARGIN
    track = tracks.by_name(settings.track)
    _check_workspace(track, settings.limits)
    return flat_plan(
        track, settings.speed, settings.slider, settings.laps, settings.period, overrun
    )


def _check_workspace(track: tracks.Track, limits: SafetyLimits) -> None:
    """A file in millimetres would otherwise make a plan of hours."""
    x, y, _, _ = track.at(np.linspace(0.0, track.length, _PLACES, endpoint=False))
    if np.abs(x).max() > limits.workspace_x or np.abs(y).max() > limits.workspace_y:
        raise InputError(
            f'track {track.name} leaves the workspace of +-{limits.workspace_x:g} m by '
            f'+-{limits.workspace_y:g} m; its points are in metres'
        )
