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
        shortest_horizon: time [s]; longer than `horizon_length` at high speeds.
        filter_delays: the model error is averaged over at least the travel in so many delays of
            the robot: commands under way cannot answer to an estimate.
    """

    steering: str
    text: str
    trained_model: bool
    shortest_horizon: float
    filter_delays: float


CONTROLLERS: Mapping[str, ControllerKind] = {
    'gp': ControllerKind(
        'push_mpc.qp:VelocitySteering',
        'one QP over the tip velocity, with the served model',
        trained_model=True,
        shortest_horizon=0.4,
        filter_delays=0.0,
    ),
    'analytical': ControllerKind(
        'push_mpc.qp:ForceSteering',
        'Family of Modes over contact force and slip',
        trained_model=False,
        shortest_horizon=0.6,
        filter_delays=5.0,
    ),
}
