"""What every model of pushing can be asked, whatever it is made of."""

from dataclasses import dataclass
from typing import Protocol

from push_core.geometry import Array


@dataclass(frozen=True)
class ModelInfo:
    """What a model is, for people and for `push_msgs/ModelInfo`.

    Attributes:
        model_hash: sha256 of everything that determines its answers.
        kind: 'gp' or 'analytical'.
        mean_function: 'zero' or 'analytical'.
        points: training pushes; 0 for the analytical model.
        training_set_hash: sha256 of the training pushes; '' for the analytical model.
        distance: travel of the pusher that one answer covers [m].
        p_y_domain: lowest and highest contact offset that it knows [m].
        beta_domain: lowest and highest push direction that it knows [rad].
        lengthscales: (3, 2) outputs by inputs [m, rad]; zeros for the analytical model.
        signal_std: (3,) [m, m, rad]; zeros for the analytical model.
        noise_std: (3,) [m, m, rad]; zeros for the analytical model.
    """

    model_hash: str
    kind: str
    mean_function: str
    points: int
    training_set_hash: str
    distance: float
    p_y_domain: tuple[float, float]
    beta_domain: tuple[float, float]
    lengthscales: Array
    signal_std: Array
    noise_std: Array

    @property
    def model_id(self) -> str:
        """Short name: the first 12 characters of the hash."""
        return self.model_hash[:12]


class PushModel(Protocol):
    """A model that answers for batches of pushes of one distance."""

    @property
    def distance(self) -> float:
        """Travel of the pusher that one answer covers [m]."""

    @property
    def info(self) -> ModelInfo:
        """What it is."""

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """Expected displacement and its Jacobian.

        Args:
            p_y: (n,) contact offsets [m].
            beta: (n,) push directions [rad].

        Returns:
            Mean (n, 3) [m, m, rad] in the body frame at the start of the push, and its
            derivatives (n, 3, 2) with respect to [p_y, beta].
        """

    def variance(self, p_y: Array, beta: Array) -> Array:
        """Variances (n, 3) of the mean, without the noise of a measurement.

        Raises:
            RunError: the model states none.
        """
