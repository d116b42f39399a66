"""The physics engines by name. A new engine is a class with the `World` interface and a line here.

Its name also goes to `ENGINE_NAMES` of the settings; a test compares the two.
"""

from collections.abc import Mapping
from dataclasses import replace
from pkgutil import resolve_name

from push_core.physics import Slider

from push_sim.settings import WorldSettings
from push_sim.worlds.common import World

ENGINES: Mapping[str, str] = {
    'bullet': 'push_sim.worlds.bullet:BulletWorld',
    'quasi_static': 'push_sim.worlds.quasi_static:QuasiStaticWorld',
}
"""The class of each engine, imported when it is used: none needs the library of another."""

COARSE_SUBSTEP = 0.005
"""Time step [s] of a coarse world."""


def make_world(settings: WorldSettings, slider: Slider) -> World:
    """A world of the engine that the settings name; close it after use.

    Args:
        settings: parameters of the world.
        slider: nominal slider; the one in the world differs by the mass and size errors.
    """
    actual = replace(
        slider,
        side=slider.side * (1.0 + settings.size_error),
        mass=slider.mass * (1.0 + settings.mass_error),
    )
    world: World = resolve_name(ENGINES[settings.engine])(settings, actual)
    return world


def make_coarse_world(settings: WorldSettings, slider: Slider) -> World:
    """A world with long time steps, for slow pushes.

    A quasi-static push ends at the same pose as with steps of 1 ms (3 um rms of 4 mm) and takes a
    fifth of the time.
    """
    return make_world(replace(settings, substep=COARSE_SUBSTEP), slider)
