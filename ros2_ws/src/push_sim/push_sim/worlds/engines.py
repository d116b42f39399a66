"""The engines behind the `World` interface, by the name that the settings give."""

from collections.abc import Callable
from dataclasses import replace

from push_core.physics import Slider

from push_sim.settings import WorldSettings
from push_sim.worlds.bullet import BulletWorld
from push_sim.worlds.common import World
from push_sim.worlds.quasi_static import QuasiStaticWorld

_ENGINES: dict[str, Callable[[WorldSettings, Slider], World]] = {
    'bullet': BulletWorld,
    'quasi_static': QuasiStaticWorld,
}


def make_world(settings: WorldSettings, slider: Slider) -> World:
    """A world of the engine that the settings name.

    Args:
        settings: of the world.
        slider: as one takes it to be; the world's own is off by the errors of the settings.
    """
    own = replace(
        slider,
        side=slider.side * (1.0 + settings.size_error),
        mass=slider.mass * (1.0 + settings.mass_error),
    )
    return _ENGINES[settings.engine](settings, own)
