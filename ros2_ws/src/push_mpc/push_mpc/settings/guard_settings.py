"""When the controller gives up, and when its reference waits for the object."""

from dataclasses import dataclass

from push_core.common import setting, validate


@dataclass(frozen=True)
class GuardSettings:
    """Limits beyond which a run does not go on."""

    solver_failures: int = setting(
        5, 'ticks in a row without a usable input at which the controller fails', low=1, high=100
    )
    tracking_error: float = setting(
        0.05, 'distance of the object from its reference at which it stops', unit='m',
        low=0.001, high=1.0,
    )  # fmt: skip
    overlap: float = setting(
        0.02, 'depth of the measured tip in the object, for frozen, at which it stops', unit='m',
        low=0.001, high=1.0,
    )  # fmt: skip
    frozen: float = setting(
        0.25, 'time of identical poses, while the tip is commanded, at which it stops', unit='s',
        low=0.05, high=10.0,
    )  # fmt: skip
    catch_up: float = setting(
        0.1, 'time without poses after which the reference goes on from where the object lies',
        unit='s', low=0.02, high=10.0,
    )  # fmt: skip

    def __post_init__(self) -> None:
        validate(self)
