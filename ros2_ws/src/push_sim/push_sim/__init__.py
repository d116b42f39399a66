"""The plant: a PyBullet world with the lag of the robot and the noise of the cameras."""

from typing import TYPE_CHECKING

from push_core.lazy import lazy_exports

if TYPE_CHECKING:
    from push_sim.collect import PushDesign as PushDesign
    from push_sim.collect import collect_pushes as collect_pushes
    from push_sim.plant import Observation as Observation
    from push_sim.plant import Plant as Plant
    from push_sim.settings import SimSettings as SimSettings
    from push_sim.settings import profile as profile
    from push_sim.worlds import make_world as make_world
    from push_sim.worlds.common import World as World
else:
    __getattr__, __dir__, __all__ = lazy_exports(
        __name__,
        {
            'collect': ['PushDesign', 'collect_pushes'],
            'plant': ['Observation', 'Plant'],
            'settings': ['SimSettings', 'profile'],
            'worlds': ['make_world'],
            'worlds.common': ['World'],
        },
    )
