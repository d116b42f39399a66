"""The moving bodies of the PyBullet world: slider and tip.

- The slider is a box on four feet on a circle, not on its corners, so that its friction moment is
  that of the measured limit surface.
- The feet are springs. The distribution of load over four rigid feet is indeterminate and depends
  on the solver's row order, so the slider would turn to one side.
- The tip is a sphere with one contact point at half height. Its mass is so large that the slider
  does not slow it down.
- PyBullet multiplies the friction coefficients of two bodies: the slider has 1, table and tip
  have their own.
- Multibody coordinates with cone friction: maximal coordinates are faster, but they restrict the
  friction of a sticking contact to one direction.
"""

from collections.abc import Sequence

from push_core.physics import GRAVITY, Pair, Slider

from push_sim.settings import WorldSettings
from push_sim.worlds.bullet.silent_pybullet import pybullet

HALF_HEIGHT = 0.0065
"""Height [m] of the slider's and of the tip's centre."""

_FEET = 4
_FOOT_RADIUS = 0.001
_TIP_MASS = 1e6
_SMALLEST_RADIUS = 1e-4
"""[m]; PyBullet has no points, so a point pusher touches this much early."""


def make_object(client: int, slider: Slider, feet: Sequence[Pair]) -> int:
    """The slider, with feet at the given positions [m]."""
    shape = _object_shape(client, slider.side, feet)
    body = make_body(client, slider.mass, shape, 1.0)
    yaw_inertia = slider.mass * slider.side**2 / 6.0
    pybullet.changeDynamics(
        body,
        -1,
        localInertiaDiagonal=(0.5 * yaw_inertia, 0.5 * yaw_inertia, yaw_inertia),
        physicsClientId=client,
    )
    return body


def make_tip(client: int, settings: WorldSettings, slider: Slider) -> int:
    """The round tip."""
    sphere = pybullet.createCollisionShape(
        pybullet.GEOM_SPHERE,
        radius=max(slider.tip_radius, _SMALLEST_RADIUS),
        physicsClientId=client,
    )
    return make_body(client, _TIP_MASS, sphere, settings.friction_pusher)


def resting_height(settings: WorldSettings, slider: Slider) -> float:
    """Height [m] of the slider when the springs carry its weight."""
    return HALF_HEIGHT - slider.mass * GRAVITY / (_FEET * settings.stiffness)


def _object_shape(client: int, side: float, feet: Sequence[Pair]) -> int:
    """A box above the table, with spheres as feet."""
    centres = [(x, y, _FOOT_RADIUS - HALF_HEIGHT) for x, y in feet]
    half_box = (side / 2.0, side / 2.0, HALF_HEIGHT - _FOOT_RADIUS)
    return int(
        pybullet.createCollisionShapeArray(
            shapeTypes=[pybullet.GEOM_SPHERE] * _FEET + [pybullet.GEOM_BOX],
            radii=[_FOOT_RADIUS] * _FEET + [0.0],
            halfExtents=[(0.0, 0.0, 0.0)] * _FEET + [half_box],
            collisionFramePositions=[*centres, (0.0, 0.0, _FOOT_RADIUS)],
            physicsClientId=client,
        )
    )


def make_body(client: int, mass: float, shape: int, friction: float) -> int:
    """A body without damping and rolling friction that is never deactivated."""
    body = int(pybullet.createMultiBody(mass, shape, physicsClientId=client))
    pybullet.changeDynamics(
        body,
        -1,
        lateralFriction=friction,
        spinningFriction=0.0,
        rollingFriction=0.0,
        restitution=0.0,
        linearDamping=0.0,
        angularDamping=0.0,
        activationState=pybullet.ACTIVATION_STATE_DISABLE_SLEEPING,
        physicsClientId=client,
    )
    return body


def set_friction(client: int, body: int, friction: float) -> None:
    """Changes the friction coefficient of a body."""
    pybullet.changeDynamics(body, -1, lateralFriction=friction, physicsClientId=client)
