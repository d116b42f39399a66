"""Controllers by name; a new one is a class with the `Steering` interface and an entry here."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class ControllerKind:
    """One controller.

    Attributes:
        steering: its class as 'module:name', imported when it is used: settings load no solver.
        text: what it optimises, for help and documents.
        trained_model: whether it needs a trained model of the object.
    """

    steering: str
    text: str
    trained_model: bool


CONTROLLERS: Mapping[str, ControllerKind] = {
    'gp': ControllerKind(
        'push_mpc.qp:VelocitySteering', 'one QP over the tip velocity, with the served model', True
    ),
    'analytical': ControllerKind(
        'push_mpc.qp:ForceSteering', 'Family of Modes over contact force and slip', False
    ),
}
