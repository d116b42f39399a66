"""Parts that all engines share: interface, outline of the square, support, table friction."""

from push_sim.worlds.common.axes import Axes, turned
from push_sim.worlds.common.outline import Outline, Pose
from push_sim.worlds.common.support import QUADRANTS, feet, friction_moment_radius
from push_sim.worlds.common.table_friction import TableFriction
from push_sim.worlds.common.world import World

__all__ = [
    'QUADRANTS',
    'Axes',
    'Outline',
    'Pose',
    'TableFriction',
    'World',
    'feet',
    'friction_moment_radius',
    'turned',
]
