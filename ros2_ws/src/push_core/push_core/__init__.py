"""The physics that all parts of the cell share, tracks, data sets; needs numpy and scipy only."""

from typing import TYPE_CHECKING

from push_core.lazy import lazy_exports

if TYPE_CHECKING:
    from push_core.common import InputError as InputError
    from push_core.common import PushError as PushError
    from push_core.common import RunError as RunError
    from push_core.data import Accuracy as Accuracy
    from push_core.data import LongPushes as LongPushes
    from push_core.data import PushSet as PushSet
    from push_core.data import accuracy as accuracy
    from push_core.data import read_long_pushes as read_long_pushes
    from push_core.data import read_pushes as read_pushes
    from push_core.data import write_pushes as write_pushes
    from push_core.geometry import displacement_of as displacement_of
    from push_core.geometry import to_body as to_body
    from push_core.geometry import to_world as to_world
    from push_core.geometry import twist_of as twist_of
    from push_core.geometry import wrap_angle as wrap_angle
    from push_core.physics import Actuator as Actuator
    from push_core.physics import ActuatorSettings as ActuatorSettings
    from push_core.physics import LimitSurface as LimitSurface
    from push_core.physics import MotionCone as MotionCone
    from push_core.physics import SafetyLimits as SafetyLimits
    from push_core.physics import Slider as Slider
    from push_core.tracks import Track as Track
else:
    __getattr__, __dir__, __all__ = lazy_exports(
        __name__,
        {
            'common': ['InputError', 'PushError', 'RunError'],
            'data': [
                'Accuracy',
                'LongPushes',
                'PushSet',
                'accuracy',
                'read_long_pushes',
                'read_pushes',
                'write_pushes',
            ],
            'geometry': ['displacement_of', 'to_body', 'to_world', 'twist_of', 'wrap_angle'],
            'physics': [
                'Actuator',
                'ActuatorSettings',
                'LimitSurface',
                'MotionCone',
                'SafetyLimits',
                'Slider',
            ],
            'tracks': ['Track'],
        },
    )
