"""Pushes at speed, from a model of slow ones: inertia makes the object turn less.

On an arc the object's centre is accelerated across its motion. The contact force that does so has
a moment about the centre, which is missing from that against the friction with the table. For the
ellipsoidal limit surface (largest force mu m g, largest moment c times it), a contact at
(p_x, p_y) and a speed v, the balance of moments is

    c^2 omega = p_x t_y - p_y t_x - |p_x| e omega,   e = v^2 / (mu g)

so that a contact that sticks turns the object as if c^2 were larger by |p_x| e. The contact point
moves with the tip in both cases. At 80, 200 and 300 mm/s e is 1.9, 12 and 26 mm.
"""

import math
from dataclasses import replace

import numpy as np

from push_core.geometry import Array
from push_core.physics.limit_surface import GRAVITY
from push_core.physics.slider import HIGHEST_FRICTION, Slider

INERTIA_FROM = 0.16
"""Speed [m/s] from which inertia is worth it: below, other errors of the models are larger."""


def with_inertia(
    slider: Slider, speed: float, p_y: Array, mean: Array, jacobian: Array
) -> tuple[Array, Array]:
    """Twists of an object that is pushed at a speed.

    Args:
        slider: its geometry, support radius and friction with the table.
        speed: of the object's centre [m/s].
        p_y: contact offsets (n,) [m].
        mean: twists (n, 3) of slow pushes, per any travel of the tip.
        jacobian: their derivatives (n, 3, 2) by p_y and push direction.

    Returns:
        Twists and derivatives, as they came.
    """
    resistance = _resistance(slider, speed)
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
    return mean - arm * turned[:, None], jacobian


def slider_at_speed(slider: Slider, speed: float) -> Slider:
    """The slider that slow pushes at p_y = 0 move as this one moves at a speed [m/s].

    Where the contact force is at the edge of the friction cone, a part of it accelerates the
    centre and does not meet friction with the table; the contact sticks farther.
    """
    square = slider.support_radius**2
    growth = 1.0 + _resistance(slider, speed) / square
    return replace(
        slider,
        friction_pusher=min(slider.friction_pusher * growth, HIGHEST_FRICTION),
        support_radius=math.sqrt(square * growth),
    )


def _resistance(slider: Slider, speed: float) -> float:
    """What inertia adds to the square of the support radius [m^2]."""
    return abs(slider.p_x) * speed**2 / (slider.friction_ground * GRAVITY)
