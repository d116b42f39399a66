"""The table of the PyBullet world.

An even table is one plane. Where friction varies it is four boxes: the axes of the physics lie
under the slider, so that each foot has a box of its own, whose friction is set in each time step
to that at the foot's place in the direction of its slip.
"""

from collections.abc import Sequence

from push_core.physics import Pair

from push_sim.settings import WorldSettings
from push_sim.worlds.bullet.bodies import make_body
from push_sim.worlds.bullet.silent_pybullet import pybullet
from push_sim.worlds.common import QUADRANTS, Axes, TableFriction

_HALF = 0.5


def make_table(client: int, settings: WorldSettings) -> list[int]:
    """The bodies of the table; they hold the springs of the feet that stand on it."""
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
    """Keeps the friction of the four boxes up to date."""

    def __init__(
        self, client: int, boxes: Sequence[int], feet: Sequence[Pair], friction: TableFriction
    ) -> None:
        self._client = client
        self._places = list(zip(boxes, feet, strict=True))
        self._friction = friction

    def update(self, axes: Axes, slider: Axes, velocity: Pair, turning: float) -> None:
        """Sets the friction for the next step.

        Args:
            axes: of the physics, in the world.
            slider: where it is in those axes.
            velocity: of the slider in those axes [m/s].
            turning: of the slider [rad/s].
        """
        for box, foot in self._places:
            x, y = slider.vector_to_world(foot)
            slip = (velocity[0] - turning * y, velocity[1] + turning * x)
            place = axes.point_to_world((slider.x + x, slider.y + y))
            coefficient = self._friction.coefficient(place, axes.vector_to_world(slip))
            pybullet.changeDynamics(
                box, -1, lateralFriction=coefficient, physicsClientId=self._client
            )
