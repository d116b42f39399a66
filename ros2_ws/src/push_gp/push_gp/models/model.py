"""The interface of every model of pushing."""

from dataclasses import dataclass
from typing import Protocol

from push_core.geometry import Array


@dataclass(frozen=True)
class ModelInfo:
    """Description of a model, as in `push_msgs/ModelInfo`.

    Attributes:
        model_hash: sha256 of everything that determines its predictions.
        kind: 'gp' or 'analytical'.
        mean_function: 'zero' or 'analytical'.
        points: training pushes; 0 for the analytical model.
        training_set_hash: sha256 of the training pushes; '' for the analytical model.
        distance: travel of the pusher in one push [m].
        p_y_domain: lowest and highest contact offset of its training data [m].
        beta_domain: lowest and highest push direction of its training data [rad].
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
    """Predicts the displacements of pushes of one distance, in batches."""

    @property
    def distance(self) -> float:
        """Travel of the pusher in one push [m]."""

    @property
    def info(self) -> ModelInfo:
        """Its description."""

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
        """Variances (n, 3) of the latent function; measurement noise not included.

        Raises:
            RunError: the model has none.
        """
