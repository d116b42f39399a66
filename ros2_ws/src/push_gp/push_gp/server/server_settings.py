"""Parameters of the model server."""

from dataclasses import dataclass

from push_core.common import nested, setting, validate
from push_core.physics import Slider

from push_gp.models import ANALYTICAL, NOMINAL_DISTANCE

_UNUSED = dict.fromkeys(('mass', 'friction_ground'), 'the motion cone does not depend on it')


@dataclass(frozen=True)
class ServerSettings:
    """What the server answers with."""

    model: str = setting(ANALYTICAL, "path of a model file, or 'analytical' for the motion cone")
    max_points: int = setting(
        5000,
        'training pushes beyond which add_pushes drops the older of the two closest; a larger '
        'model is served as it is until then',
        low=1,
        high=20_000,
    )
    distance: float = setting(
        NOMINAL_DISTANCE,
        'travel of the pusher that one answer of the analytical model covers',
        unit='m',
        low=1e-4,
        high=0.1,
    )
    learn: bool = setting(
        False, 'let each lap teach the next one: model and shift of the reference'
    )
    lesson: str = setting('', 'file of what laps before have taught, to go on from; none if empty')
    mode: str = setting(
        'realtime',
        'clock of the cell that it learns from: the system clock, or /clock',
        choices=('realtime', 'lockstep'),
    )
    slider: Slider = nested(Slider(), _UNUSED)

    def __post_init__(self) -> None:
        validate(self)
