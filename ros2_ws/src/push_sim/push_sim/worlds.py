"""The engines behind the `World` interface, by the name that the settings give."""

from collections.abc import Callable

from push_core.slider import Slider

from push_sim.bullet_world import BulletWorld
from push_sim.quasi_static_world import QuasiStaticWorld
from push_sim.settings import WorldSettings
from push_sim.world import World

_ENGINES: dict[str, Callable[[WorldSettings, Slider], World]] = {
    'bullet': BulletWorld,
    'quasi_static': QuasiStaticWorld,
}


def make_world(settings: WorldSettings, slider: Slider) -> World:
    """A world of the engine that the settings name, for a slider."""
    return _ENGINES[settings.engine](settings, slider)
