"""Everything that can be said about the plant, and the profiles that bundle it.

The shape of the slider is `push_core.physics.slider.Slider`, which the controller knows too. Its
friction on the table and on the tip belongs to the world: the controller learns or assumes it.
"""

import math
from dataclasses import dataclass
from enum import IntEnum

from push_core.common import InputError, nested, setting, validate
from push_core.physics import ACTUATORS, ActuatorSettings

PERIOD = 0.01
"""Time [s] from one exposure to the next; commands are answered as often."""


ENGINE_NAMES = ('bullet', 'quasi_static')
"""What can move the bodies."""


@dataclass(frozen=True)
class WorldSettings:
    """The rigid bodies, their friction, and how finely time is cut.

    The friction of the pusher and the support radius are those that `calibrate` finds in the
    measured pushes, as docs/plant.md tells.
    """

    engine: str = setting(
        'bullet',
        'physics; quasi_static: the motion cone of an ellipsoid, no inertia',
        choices=ENGINE_NAMES,
    )
    substep: float = setting(
        0.001, 'time step, a whole fraction of 0.01', unit='s', low=1e-5, high=PERIOD
    )
    friction_ground: float = setting(0.35, 'friction of slider on table', low=0.01, high=2.0)
    friction_pusher: float = setting(0.196, 'friction of slider on tip', low=0.0, high=2.0)
    support_radius: float = setting(
        0.0373, 'distance of the four feet from the centre', unit='m', low=1e-3, high=0.5
    )
    pressure: str = setting(
        'calibrated',
        'how it presses on the table; calibrated: by support_radius',
        choices=('calibrated', 'uniform', 'centred', 'rim', 'random'),
    )
    friction_variation: float = setting(
        0.0, 'relative standard deviation of the friction over the table', low=0.0, high=0.3
    )
    friction_length: float = setting(
        0.05, 'distance over which that friction varies', unit='m', low=5e-3, high=10.0
    )
    friction_anisotropy: float = setting(
        1.0, 'friction on the table along world x over that along y', low=0.25, high=4.0
    )
    mass_error: float = setting(
        0.0, 'relative excess of the mass over what is assumed', low=-0.5, high=1.0
    )
    size_error: float = setting(
        0.0, 'relative excess of the side over what is assumed', low=-0.2, high=0.2
    )
    stiffness: float = setting(1e5, 'stiffness of each foot', unit='N/m', low=1e3, high=1e7)
    damping: float = setting(200.0, 'damping of each foot', unit='N s/m', low=0.0, high=1e5)
    solver_iterations: int = setting(200, 'most iterations a step', low=10, high=10000)
    solver_residual: float = setting(
        1e-10, 'squared impulse error of a 1 ms step at which iterating ends', low=0.0, high=1e-3
    )

    def __post_init__(self) -> None:
        validate(self)
        if not math.isclose(PERIOD / self.substep, self.substeps, rel_tol=1e-9):
            raise InputError(
                f'parameter world.substep is {self.substep:g}, must divide {PERIOD:g} s'
            )
        for name, even in (('friction_variation', 0.0), ('friction_anisotropy', 1.0)):
            if self.engine == 'quasi_static' and getattr(self, name) != even:
                raise InputError(
                    f'parameter world.{name} is {getattr(self, name):g}, must be {even:g} '
                    'with world.engine quasi_static'
                )

    @property
    def uneven(self) -> bool:
        """Whether the friction on the table depends on place or direction."""
        return self.friction_variation > 0.0 or self.friction_anisotropy != 1.0

    @property
    def substeps(self) -> int:
        """Time steps in a period."""
        return round(PERIOD / self.substep)


@dataclass(frozen=True)
class SensorSettings:
    """The cameras that see the slider."""

    position_noise: float = setting(
        0.05e-3, 'standard deviation of x and of y', unit='m', low=0.0, high=0.1
    )
    angle_noise: float = setting(
        math.radians(0.008), 'standard deviation of theta', unit='rad', low=0.0, high=1.0
    )
    latency: float = setting(
        0.005, 'time from exposure to publication', unit='s', low=0.0, high=0.5
    )
    jitter: float = setting(
        0.0, 'most that a picture comes later, drawn for each', unit='s', low=0.0, high=0.009
    )
    dropout: float = setting(0.0, 'share of pictures that get lost', low=0.0, high=0.9)
    freeze_rate: float = setting(
        0.0, 'how often the pose stands still for 0.1 s', unit='1/s', low=0.0, high=5.0
    )

    def __post_init__(self) -> None:
        validate(self)


class PerturbationKind(IntEnum):
    """Kinds of perturbations; the numbers are those of push_msgs/Perturbation."""

    NORMAL = 0
    TANGENTIAL = 1
    IMPULSE = 2


@dataclass(frozen=True)
class PerturbationSettings:
    """One perturbation that is applied without a service call."""

    kind: str = setting(
        'none', 'what happens', choices=('none', *(kind.name.lower() for kind in PerturbationKind))
    )
    magnitude: float = setting(
        0.0, 'size in m or N s; 0 takes 30 mm, 20 mm or 0.3 N s', low=-1.0, high=1.0
    )
    angle: float = setting(0.0, 'world direction of an impulse', unit='rad', low=-7.0, high=7.0)
    time: float = setting(
        0.0, 'when, after the first non-zero command; 0 is at reset', unit='s', low=0.0, high=1e4
    )

    def __post_init__(self) -> None:
        validate(self)


@dataclass(frozen=True)
class SimSettings:
    """The whole plant."""

    world: WorldSettings = nested(WorldSettings())
    actuator: ActuatorSettings = nested(ACTUATORS['irb120'])
    sensor: SensorSettings = nested(SensorSettings())
    perturbation: PerturbationSettings = nested(PerturbationSettings())
    command_timeout: float = setting(
        0.05, 'the driver brakes after this long without a command', unit='s', low=0.001, high=10.0
    )
    command_loss: float = setting(0.0, 'share of commands that get lost', low=0.0, high=0.9)

    def __post_init__(self) -> None:
        validate(self)
