"""The plants of `bench mismatch`: what is pushed, and where the plant differs from the default.

They are for measuring only: the controller has one set of parameters for all of them.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from push_bringup.experiment import PAPER_MM, Experiment

_EIGHT = Experiment('eight', 0.08)
_FAST = {
    'limits.speed': 1.0,
    'actuator.speed_limit': 1.0,
    'normal_speed_limit': 1.0,
    'tangential_speed_limit': 0.6,
    'guard.tracking_error': 0.1,
}


@dataclass(frozen=True)
class PlantVariant:
    """One plant.

    Attributes:
        text: how it differs.
        overrides: parameters that make the difference, as `cell -p` takes them.
        experiment: what is pushed on it.
        profile: of robot and cameras.
    """

    text: str
    overrides: Mapping[str, object] = field(default_factory=dict)
    experiment: Experiment = _EIGHT
    profile: str = 'irb120'


def _world(text: str, name: str, value: object) -> PlantVariant:
    return PlantVariant(text, {f'world.{name}': value})


def _noise(millimetres: float, degrees: float) -> PlantVariant:
    return PlantVariant(
        f'camera noise {millimetres:g} mm, {degrees:g}°',
        {
            'sensor.position_noise': 1e-3 * millimetres,
            'sensor.angle_noise': math.radians(degrees),
        },
    )


def _robot(text: str, name: str, milliseconds: int) -> PlantVariant:
    return PlantVariant(
        f'{text} {milliseconds} ms', {f'sim_node.actuator.{name}': 1e-3 * milliseconds}
    )


def _fast(speed: int) -> PlantVariant:
    return PlantVariant(
        f'{speed} mm/s, limits raised', _FAST, Experiment(_EIGHT.track, 1e-3 * speed)
    )


PLANTS: Mapping[str, PlantVariant] = {
    'home': PlantVariant('nothing'),
    **{
        f'friction_{value}': _world(f'friction of the tip {value}', 'friction_pusher', value)
        for value in (0.1, 0.3, 0.4, 0.6)
    },
    'rim': _world('pressure at the rim', 'pressure', 'rim'),
    'centred': _world('pressure in the centre', 'pressure', 'centred'),
    'support_28': _world('support radius 28 mm', 'support_radius', 0.028),
    'support_60': _world('support radius 60 mm', 'support_radius', 0.060),
    'varies_0.2': _world('friction of the table varies by 0.2', 'friction_variation', 0.2),
    'varies_0.3': _world('friction of the table varies by 0.3', 'friction_variation', 0.3),
    'smaller': _world('object 10 % smaller', 'size_error', -0.1),
    'larger': _world('object 10 % larger', 'size_error', 0.1),
    'noise_0.5': _noise(0.5, 0.5),
    'noise_1': _noise(1.0, 1.0),
    'webcam': PlantVariant('profile webcam', profile='webcam'),
    'half_lost': PlantVariant('half of the pictures lost', {'sensor.dropout': 0.5}),
    'dead_time_20': _robot('dead time', 'dead_time', 20),
    'dead_time_120': _robot('dead time', 'dead_time', 120),
    'lag_20': _robot('lag', 'lag', 20),
    'lag_120': _robot('lag', 'lag', 120),
    'speed_200': _fast(200),
    'speed_250': _fast(250),
    'speed_300': _fast(300),
    'quasi_static': _world('another engine, without inertia', 'engine', 'quasi_static'),
    # the remaining rows of the paper's table; the first is home
    **{
        f'{each.track}_{1e3 * each.speed:.0f}_{each.perturbation}': PlantVariant(
            'nothing', experiment=each
        )
        for each in PAPER_MM
        if each != _EIGHT
    },
}
"""Name of a plant, to what it is."""
