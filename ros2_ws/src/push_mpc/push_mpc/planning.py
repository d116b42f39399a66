"""From the node's parameters to the plan that it tracks."""

from push_core import tracks
from push_core.errors import InputError

from push_mpc.node_settings import MpcSettings
from push_mpc.nominal import Plan, flat_plan

_MARGIN = 0.5  # [s] beyond horizon and delay


def planned(settings: MpcSettings) -> Plan:
    """The plan along the track that the settings name.

    Raises:
        InputError: an unknown track, a track that cannot be pushed, or too high a speed.
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
    return flat_plan(
        track, settings.speed, settings.slider, settings.laps, settings.period, overrun
    )
