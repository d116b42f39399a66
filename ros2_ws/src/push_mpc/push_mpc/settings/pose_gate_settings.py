"""Settings of the gate that measured poses pass."""

from dataclasses import dataclass

from push_core.common import setting, validate


@dataclass(frozen=True)
class PoseGateSettings:
    """Which poses are accepted."""

    frame: str = setting('world', 'frame of the poses; an empty frame_id counts as this one')
    max_age: float = setting(
        0.06, 'age of a stamp, by the clock of this node, that is accepted', unit='s',
        low=0.01, high=10.0,
    )  # fmt: skip
    clock_tolerance: float = setting(
        0.005, 'time by which a stamp may lie in the future', unit='s', low=0.0, high=1.0
    )
    pair_tolerance: float = setting(
        0.005, 'difference of the stamps of object and tip that still pair', unit='s',
        low=0.0, high=0.1,
    )  # fmt: skip
    largest_jump: float = setting(
        0.05, 'distance of two poses in a row from which the second is refused', unit='m',
        low=0.001, high=10.0,
    )  # fmt: skip

    def __post_init__(self) -> None:
        validate(self)
