"""The table of the PyBullet world.

A table with constant friction is one plane. A table with varying friction is four boxes, one for
each foot: the physics axes lie under the slider. In each time step the friction of a box is set
to that at the position of its foot and in the direction of its slip.
"""

from collections.abc import Sequence

from push_core.physics import Pair

from push_sim.settings import WorldSettings
from push_sim.worlds.bullet.bodies import make_body, set_friction
from push_sim.worlds.bullet.silent_pybullet import pybullet
from push_sim.worlds.common import QUADRANTS, Axes, TableFriction

_HALF = 0.5


def make_table(client: int, settings: WorldSettings) -> list[int]:
    """The bodies of the table; their contact stiffness makes the feet springs."""
    bodies = _boxes(client, settings) if settings.uneven else [_plane(client, settings)]
    for body in bodies:
        pybullet.changeDynamics(
            body,
            -1,
            contactStiffness=settings.stiffness,
            contactDamping=settings.damping,
            physicsClientId=client,
        )
    return bodies


def _plane(client: int, settings: WorldSettings) -> int:
    plane = pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=client)
    return make_body(client, 0.0, plane, settings.friction_ground)


def _boxes(client: int, settings: WorldSettings) -> list[int]:
    box = pybullet.createCollisionShape(
        pybullet.GEOM_BOX, halfExtents=(_HALF, _HALF, _HALF), physicsClientId=client
    )
    bodies = []
    for x, y in QUADRANTS:
        body = make_body(client, 0.0, box, settings.friction_ground)
        centre = (x * _HALF, y * _HALF, -_HALF)
        pybullet.resetBasePositionAndOrientation(body, centre, (0.0, 0.0, 0.0, 1.0), client)
        bodies.append(body)
    return bodies


class UnevenTable:
    """Updates the friction of the four boxes."""

    def __init__(
        self, client: int, boxes: Sequence[int], feet: Sequence[Pair], friction: TableFriction
    ) -> None:
        self._client = client
        self._feet = list(zip(boxes, feet, strict=True))
        self._friction = friction

    def update(self, axes: Axes, slider: Axes, velocity: Pair, turn_rate: float) -> None:
        """Sets the friction for the next step.

        Args:
            axes: physics axes in the world.
            slider: pose of the slider in the physics axes.
            velocity: velocity of the slider in the physics axes [m/s].
            turn_rate: angular velocity of the slider [rad/s].
        """
        for box, foot in self._feet:
            x, y = slider.vector_to_world(foot)
            slip = (velocity[0] - turn_rate * y, velocity[1] + turn_rate * x)
            position = axes.point_to_world((slider.x + x, slider.y + y))
            coefficient = self._friction.coefficient(position, axes.vector_to_world(slip))
            set_friction(self._client, box, coefficient)
