"""The engines behind the `World` interface, by the name that the settings give."""

from collections.abc import Callable
from dataclasses import replace

from push_core.physics.slider import Slider

from push_sim.settings.plant_settings import WorldSettings
from push_sim.worlds.bullet.bullet_world import BulletWorld
from push_sim.worlds.common.world import World
from push_sim.worlds.quasi_static.quasi_static_world import QuasiStaticWorld

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
