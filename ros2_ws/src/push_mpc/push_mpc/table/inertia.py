"""A model of slow pushes at the speed of a plan: inertia makes the object turn less.

On an arc the object's centre is accelerated across its motion. The contact force that does so has
a moment about the centre, which is missing from that against the friction with the table. For the
ellipsoidal limit surface (largest force mu m g, largest moment c times it), a contact at
(p_x, p_y) and a speed v, the balance of moments is

    c^2 omega = p_x t_y - p_y t_x - |p_x| e omega,   e = v^2 / (mu g)

so that a contact that sticks turns the object as if c^2 were larger by |p_x| e. The contact point
moves with the tip in both cases. At 80, 200 and 300 mm/s e is 1.9, 12 and 26 mm.
"""

import numpy as np
from push_core.physics import Slider

from push_mpc.table.surrogate import Table

_GRAVITY = 9.81  # [m/s^2]


def with_inertia(table: Table, slider: Slider, speed: float) -> Table:
    """The table of an object that is pushed at a speed [m/s].

    Args:
        table: of slow pushes.
        slider: its geometry, support radius and friction with the table.
        speed: of the object's centre.
    """
    p_y, beta = table.grid.points()
    mean, jacobian = table.evaluate(p_y, beta)
    resistance = abs(slider.p_x) * speed**2 / (slider.friction_ground * _GRAVITY)
    mobility = slider.support_radius**2 + slider.p_x**2 + p_y**2
    # omega without inertia times `lost` is what inertia takes from it
    lost = resistance / (mobility + resistance)
    by_p_y = -2.0 * p_y * lost / (mobility + resistance)
    turned = mean[:, 2] * lost
    slopes = jacobian[:, 2] * lost[:, None]
    slopes[:, 0] += mean[:, 2] * by_p_y
    arm = np.column_stack([p_y, np.full(p_y.size, -slider.p_x), np.ones(p_y.size)])
    jacobian = jacobian - arm[:, :, None] * slopes[:, None, :]
    jacobian[:, 0, 0] -= turned
    return Table(table.grid, mean - arm * turned[:, None], jacobian)
