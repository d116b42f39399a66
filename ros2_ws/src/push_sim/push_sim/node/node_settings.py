"""Parameters of the simulator node: those of the plant, and its start."""

from dataclasses import dataclass, fields

import numpy as np
from push_core.common import RealtimeSettings, nested, setting, validate
from push_core.geometry import Array
from push_core.physics import Slider

from push_sim.settings import PROFILES, SimSettings, profile


@dataclass(frozen=True)
class StartSettings:
    """Slider and tip at the start of the node; `push_sim/reset` moves them."""

    x: float = setting(0.0, 'x of the slider', unit='m', low=-10.0, high=10.0)
    y: float = setting(0.0, 'y of the slider', unit='m', low=-10.0, high=10.0)
    theta: float = setting(0.0, 'heading of the slider', unit='rad', low=-7.0, high=7.0)
    p_y: float = setting(0.0, 'contact offset of the tip', unit='m', low=-0.05, high=0.05)
    gap: float = setting(0.0, 'distance of the tip from the face', unit='m', low=0.0, high=1.0)

    def __post_init__(self) -> None:
        validate(self)

    @property
    def object_pose(self) -> Array:
        """Pose (3,) of the slider: x [m], y [m], theta [rad]."""
        return np.array([self.x, self.y, self.theta])

    def tip_position(self, slider: Slider) -> Array:
        """Centre (2,) of the tip [m] at the face of a slider."""
        return slider.tip_position(self.object_pose, self.p_y, self.gap)


# what the controller assumes of the slider's friction is not what the plant has
_WORLDS_OWN = {
    name: f"the plant's own is world.{name}"
    for name in ('friction_ground', 'friction_pusher', 'support_radius')
}


@dataclass(frozen=True)
class NodeSettings(SimSettings):
    """The plant's settings and the node's own."""

    profile: str = setting('irb120', 'set of defaults', choices=tuple(PROFILES))
    mode: str = setting(
        'realtime',
        'realtime: wall clock; lockstep: each command steps the plant',
        choices=('realtime', 'lockstep'),
    )
    seed: int = setting(0, 'seed of everything random', low=0, high=2**62)
    start: StartSettings = nested(StartSettings())
    realtime: RealtimeSettings = nested(RealtimeSettings())
    slider: Slider = nested(Slider(), _WORLDS_OWN)


_CHANGEABLE = (
    *('sensor.', 'perturbation.', 'command_', 'start_offset.'),
    *('world.friction_ground', 'world.friction_pusher'),
)


def is_changeable(name: str) -> bool:
    """Whether a parameter may change while the plant runs; the schedule of pictures may not."""
    return name not in ('sensor.latency', 'sensor.rate') and name.startswith(_CHANGEABLE)


def node_settings(profile_name: str) -> NodeSettings:
    """The node's parameters with the defaults of a profile.

    Raises:
        InputError: there is no such profile.
    """
    sim = profile(profile_name)
    values = {field.name: getattr(sim, field.name) for field in fields(sim)}
    return NodeSettings(profile=profile_name, **values)
