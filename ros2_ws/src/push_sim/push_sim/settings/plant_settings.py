"""Parameters of the plant: world, actuator, sensor, perturbation and start offset."""

import math
from dataclasses import dataclass
from enum import IntEnum

from push_core.common import InputError, nested, setting, validate
from push_core.physics import ACTUATORS, ActuatorSettings, SafetyLimits

from push_sim.settings.world_settings import PERIOD, WorldSettings

_ROUNDING = 1e-9  # of a number of periods


@dataclass(frozen=True)
class SensorSettings:
    """Cameras that measure object and tip."""

    position_noise: float = setting(
        0.05e-3, 'standard deviation of the x and y of the object', unit='m', low=0.0, high=0.1
    )
    angle_noise: float = setting(
        math.radians(0.008),
        'standard deviation of the heading of the object',
        unit='rad',
        low=0.0,
        high=1.0,
    )
    angle_bias: float = setting(
        0.0, 'constant error of the heading of the object', unit='rad', low=-1.0, high=1.0
    )
    tip_noise: float = setting(
        0.0, 'standard deviation of the x and y of the tip', unit='m', low=0.0, high=0.1
    )
    tip_bias_x: float = setting(
        0.0, 'constant error of the x of the tip', unit='m', low=-0.05, high=0.05
    )
    tip_bias_y: float = setting(
        0.0, 'constant error of the y of the tip', unit='m', low=-0.05, high=0.05
    )
    latency: float = setting(
        0.005, 'time from exposure to publication', unit='s', low=0.0, high=0.5
    )
    jitter: float = setting(
        0.0, 'largest additional latency, random for each picture', unit='s', low=0.0, high=0.1
    )
    rate: float = setting(
        1.0 / PERIOD, 'pictures per second', unit='1/s', low=1.0, high=1.0 / PERIOD
    )
    dropout: float = setting(0.0, 'fraction of pictures that are lost', low=0.0, high=0.9)
    freeze_rate: float = setting(
        0.0,
        'rate of freezes of the object pose, for 0.1 s each',
        unit='1/s',
        low=0.0,
        high=5.0,
    )

    def __post_init__(self) -> None:
        validate(self)
        if self.jitter >= self.shortest_interval:
            raise InputError(
                f'parameter sensor.jitter is {self.jitter:g}, must be less than the shortest time '
                f'between two pictures, {self.shortest_interval:g} s at a sensor.rate of '
                f'{self.rate:g} 1/s'
            )

    @property
    def grid(self) -> tuple[float, float]:
        """Latency and rate, which the schedule of the pictures is made of."""
        return self.latency, self.rate

    def due(self, picture: int) -> int:
        """The period at whose end a picture is published; periods and pictures count from 0."""
        return math.ceil(picture / (self.rate * PERIOD) - _ROUNDING)

    @property
    def shortest_interval(self) -> float:
        """Shortest time [s] between two pictures: they are published at the ends of periods."""
        return math.floor(1.0 / (self.rate * PERIOD) + _ROUNDING) * PERIOD


class PerturbationKind(IntEnum):
    """Kinds of perturbations; the numbers are those of push_msgs/Perturbation."""

    NORMAL = 0
    TANGENTIAL = 1
    IMPULSE = 2


@dataclass(frozen=True)
class PerturbationSettings:
    """One perturbation that is applied without a service call."""

    kind: str = setting(
        'none',
        'kind of the perturbation',
        choices=('none', *(kind.name.lower() for kind in PerturbationKind)),
    )
    magnitude: float = setting(
        0.0, 'magnitude [m] or [N s]; 0: 30 mm, 20 mm or 0.3 N s', low=-1.0, high=1.0
    )
    angle: float = setting(
        0.0, 'direction of an impulse in the world', unit='rad', low=-7.0, high=7.0
    )
    time: float = setting(
        0.0, 'delay after the first non-zero command; 0: at the reset', unit='s', low=0.0, high=1e4
    )

    def __post_init__(self) -> None:
        validate(self)


@dataclass(frozen=True)
class StartOffset:
    """Error of the object's placement at a reset, in the frame of the requested pose."""

    x: float = setting(0.0, 'offset along the normal of the face', unit='m', low=-0.1, high=0.1)
    y: float = setting(0.0, 'offset along the face', unit='m', low=-0.1, high=0.1)
    theta: float = setting(0.0, 'offset of the heading', unit='rad', low=-1.0, high=1.0)

    def __post_init__(self) -> None:
        validate(self)


@dataclass(frozen=True)
class SimSettings:
    """The whole plant."""

    world: WorldSettings = nested(WorldSettings())
    actuator: ActuatorSettings = nested(ACTUATORS['irb120'])
    sensor: SensorSettings = nested(SensorSettings())
    perturbation: PerturbationSettings = nested(PerturbationSettings())
    start_offset: StartOffset = nested(StartOffset())
    limits: SafetyLimits = nested(
        SafetyLimits(), {'acceleration': 'the driver has actuator.acceleration_limit'}
    )
    command_timeout: float = setting(
        0.05,
        'time without a command until the driver brakes',
        unit='s',
        low=0.001,
        high=10.0,
    )
    command_loss: float = setting(0.0, 'fraction of commands that are lost', low=0.0, high=0.9)

    def __post_init__(self) -> None:
        validate(self)
        substeps = self.sensor.latency / self.world.substep
        if not math.isclose(substeps, self.latency_substeps, abs_tol=1e-6):
            raise InputError(
                f'parameter sensor.latency is {self.sensor.latency:g}, '
                f'must be a multiple of world.substep = {self.world.substep:g} s'
            )

    @property
    def latency_substeps(self) -> int:
        """Latency of the sensor in time steps."""
        return round(self.sensor.latency / self.world.substep)
