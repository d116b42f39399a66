"""Parameters of the world: rigid bodies, friction, time step.

The geometry of the slider is `push_core.physics.Slider`, which the controller knows too. Its
friction on table and tip belongs to the world: the controller learns or assumes it.
"""

import math
from dataclasses import dataclass

from push_core.common import InputError, setting, validate

PERIOD = 0.01
"""Time [s] between two exposures, and between two commands."""

ENGINE_NAMES = ('bullet', 'quasi_static')
"""Choices of `world.engine`; the classes are in `push_sim.worlds.engines`."""


@dataclass(frozen=True)
class WorldSettings:
    """Rigid bodies, friction and time step.

    The defaults of the friction of the pusher and of the support radius were fitted to measured
    pushes by `calibrate`, see docs/plant.md.
    """

    engine: str = setting(
        'bullet',
        'physics engine; quasi_static: motion cone of an ellipsoid, no inertia',
        choices=ENGINE_NAMES,
    )
    substep: float = setting(
        0.001, 'time step; must divide 0.01 s', unit='s', low=1e-5, high=PERIOD
    )
    friction_ground: float = setting(
        0.35, 'friction coefficient of slider and table', low=0.01, high=2.0
    )
    friction_pusher: float = setting(
        0.196, 'friction coefficient of slider and tip', low=0.0, high=2.0
    )
    support_radius: float = setting(
        0.0373, 'distance of the four feet from the centre', unit='m', low=1e-3, high=0.5
    )
    pressure: str = setting(
        'calibrated',
        'distribution of the pressure on the table; calibrated: by support_radius',
        choices=('calibrated', 'uniform', 'centred', 'rim', 'random'),
    )
    friction_variation: float = setting(
        0.0, 'relative standard deviation of the friction over the table', low=0.0, high=0.3
    )
    friction_length: float = setting(
        0.05, 'correlation length of that variation', unit='m', low=5e-3, high=10.0
    )
    friction_anisotropy: float = setting(
        1.0, 'friction on the table along world x, divided by that along y', low=0.25, high=4.0
    )
    mass_error: float = setting(
        0.0, 'relative error of the assumed mass; 0.1: 10 % heavier', low=-0.5, high=1.0
    )
    size_error: float = setting(
        0.0, 'relative error of the assumed side; 0.1: 10 % larger', low=-0.2, high=0.2
    )
    stiffness: float = setting(1e5, 'stiffness of each foot', unit='N/m', low=1e3, high=1e7)
    damping: float = setting(200.0, 'damping of each foot', unit='N s/m', low=0.0, high=1e5)
    solver_iterations: int = setting(
        200, 'iteration limit of the contact solver in a step', low=10, high=10000
    )
    solver_residual: float = setting(
        1e-10,
        'squared impulse residual at which the solver of a 1 ms step stops',
        low=0.0,
        high=1e-3,
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
        """Whether the friction on the table depends on position or direction."""
        return self.friction_variation > 0.0 or self.friction_anisotropy != 1.0

    @property
    def substeps(self) -> int:
        """Time steps in a period."""
        return round(PERIOD / self.substep)
