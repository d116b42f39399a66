"""The same regression by three libraries: ours, scikit-learn and GPyTorch.

Each fits one Gaussian process per output with the kernel of the paper, by maximum likelihood, on
one thread in double precision, and then predicts means and Jacobians.
"""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from push_core.data import HALF_FACE, PushSet
from push_core.geometry import Array
from push_gp.regression import Hyperparameters, MarginalLikelihood
from push_gp.training import OVER_ZERO, priors
from push_gp.training.train import train

Predict: TypeAlias = Callable[[Array], tuple[Array, Array]]
"""From (m, 2) queries to mean (m, 3) and Jacobian (m, 3, 2)."""

STEPS = np.array([1e-6, 1e-5])
"""Of the finite differences [m, rad] where a library has no gradient."""

ITERATIONS = 200


@dataclass(frozen=True)
class LibraryFit:
    """A model that a library fitted.

    Attributes:
        hyperparameters: of dx, dy and dtheta.
        predict: mean and Jacobian of the model.
    """

    hyperparameters: Sequence[Hyperparameters]
    predict: Predict

    def log_likelihood(self, pushes: PushSet) -> float:
        """Of the training pushes [nat], all outputs, computed by our formula for every library."""
        return sum(
            MarginalLikelihood(pushes.inputs, outputs).with_gradient(each)[0]
            for outputs, each in zip(pushes.displacement.T, self.hyperparameters, strict=True)
        )


def fit_ours(pushes: PushSet) -> LibraryFit:
    """push_gp."""
    model = train(pushes)
    return LibraryFit(
        [process.hyperparameters for process in model.processes],
        lambda queries: model.evaluate(*queries.T),
    )


def fit_scikit_learn(pushes: PushSet) -> LibraryFit:
    """scikit-learn; the Jacobian is by central differences, as it has no gradients of the mean."""
    # optional: installed by the extra `bench`
    from sklearn.exceptions import ConvergenceWarning  # noqa: PLC0415
    from sklearn.gaussian_process import GaussianProcessRegressor  # noqa: PLC0415
    from sklearn.gaussian_process.kernels import (  # noqa: PLC0415
        RBF,
        ConstantKernel,
        WhiteKernel,
    )

    processes, hyperparameters = [], []
    for start, scale, outputs in _outputs(pushes):
        kernel = ConstantKernel(start.signal_std**2, (1e-6, 1e3)) * RBF(
            np.array(start.lengthscales) / np.sqrt(2.0), (1e-2, 1e2)
        ) + WhiteKernel(start.noise_std**2, (1e-8, 1.0))
        process = GaussianProcessRegressor(kernel, alpha=0.0)
        with warnings.catch_warnings():
            # about parameters that end near their bounds, which are as wide as ours
            warnings.simplefilter('ignore', ConvergenceWarning)
            process.fit(_scaled(pushes.inputs), outputs)
        signal, length, noise = np.split(np.exp(process.kernel_.theta), [1, 3])
        lengths = np.sqrt(2.0) * length * [HALF_FACE, 1.0]
        processes.append((process, scale))
        hyperparameters.append(
            _in_si(lengths, np.sqrt(signal[0]) * scale, np.sqrt(noise[0]) * scale)
        )

    def mean(queries: Array) -> Array:
        parts = [process.predict(_scaled(queries)) * scale for process, scale in processes]
        return np.column_stack(parts)

    def predict(queries: Array) -> tuple[Array, Array]:
        count = len(queries)
        shifts = np.vstack((np.zeros(2), np.diag(STEPS), -np.diag(STEPS)))
        means = mean((queries + shifts[:, None]).reshape(-1, 2)).reshape(5, count, 3)
        jacobian = np.stack((means[1] - means[3], means[2] - means[4]), axis=-1) / (2.0 * STEPS)
        return means[0], jacobian

    return LibraryFit(hyperparameters, predict)


def fit_gpytorch(pushes: PushSet) -> LibraryFit:
    """GPyTorch with exact Cholesky factors and L-BFGS; gradients by autograd."""
    # optional: installed by the extra `bench`
    import gpytorch  # noqa: PLC0415
    import torch  # noqa: PLC0415

    torch.set_num_threads(1)
    inputs = torch.tensor(_scaled(pushes.inputs), dtype=torch.float64)
    exact = gpytorch.settings.max_cholesky_size(len(pushes) + 1)
    models, hyperparameters = [], []
    with exact, gpytorch.settings.fast_computations(False, False, False):
        for start, scale, outputs in _outputs(pushes):
            model = _torch_process(inputs, torch.tensor(outputs), start)
            _maximise_torch(model)
            model.eval()
            kernel = model.covar_module
            lengths = np.sqrt(2.0) * kernel.base_kernel.lengthscale.detach().numpy()[0]
            signal, noise = kernel.outputscale.item() ** 0.5, model.likelihood.noise.item() ** 0.5
            models.append((model, scale))
            hyperparameters.append(
                _in_si(lengths * [HALF_FACE, 1.0], signal * scale, noise * scale)
            )

    def predict(queries: Array) -> tuple[Array, Array]:
        mean, jacobian = np.empty((len(queries), 3)), np.empty((len(queries), 3, 2))
        with exact, gpytorch.settings.skip_posterior_variances():
            for column, (model, scale) in enumerate(models):
                points = torch.tensor(_scaled(queries), requires_grad=True)
                values = model(points).mean
                (slope,) = torch.autograd.grad(values.sum(), points)
                mean[:, column] = scale * values.detach().numpy()
                jacobian[:, column] = scale * slope.numpy() / [HALF_FACE, 1.0]
        return mean, jacobian

    return LibraryFit(hyperparameters, predict)


def _torch_process(inputs: Any, outputs: Any, start: Hyperparameters) -> Any:
    import gpytorch  # noqa: PLC0415

    class Process(gpytorch.models.ExactGP):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__(inputs, outputs, gpytorch.likelihoods.GaussianLikelihood())
            self.mean_module = gpytorch.means.ZeroMean()
            kernel = gpytorch.kernels.RBFKernel(ard_num_dims=2)
            self.covar_module = gpytorch.kernels.ScaleKernel(kernel)

        def forward(self, points: Any) -> Any:
            covariance = self.covar_module(points)
            return gpytorch.distributions.MultivariateNormal(self.mean_module(points), covariance)

    model = Process().double()
    lengths = np.array([start.lengthscales]) / np.sqrt(2.0)
    model.covar_module.base_kernel.lengthscale = inputs.new_tensor(lengths)
    model.covar_module.outputscale = start.signal_std**2
    model.likelihood.noise = start.noise_std**2
    return model


def _maximise_torch(model: Any) -> None:
    import gpytorch  # noqa: PLC0415
    import torch  # noqa: PLC0415

    model.train()
    likelihood = gpytorch.mlls.ExactMarginalLogLikelihood(model.likelihood, model)
    search = torch.optim.LBFGS(
        model.parameters(), max_iter=ITERATIONS, line_search_fn='strong_wolfe'
    )

    def loss() -> Any:
        search.zero_grad()
        value = -likelihood(model(*model.train_inputs), model.train_targets)
        value.backward()
        return value

    search.step(loss)


def _outputs(pushes: PushSet) -> list[tuple[Hyperparameters, float, Array]]:
    """For each output: where the search starts, its unit, and the values in that unit.

    The start is that of push_gp, in half faces, radians and units of the output.
    """
    parts = []
    for outputs, prior in zip(
        pushes.displacement.T, priors(OVER_ZERO, pushes.distance), strict=True
    ):
        centre, scale = Hyperparameters.from_logarithms(prior.centre), float(outputs.std())
        lengths = np.array(centre.lengthscales) / [HALF_FACE, 1.0]
        start = _in_si(lengths, centre.signal_std / scale, centre.noise_std / scale)
        parts.append((start, scale, outputs / scale))
    return parts


def _scaled(inputs: Array) -> Array:
    return np.asarray(inputs / [HALF_FACE, 1.0])


def _in_si(lengths: Array, signal: float, noise: float) -> Hyperparameters:
    first, second = (float(length) for length in lengths)
    return Hyperparameters((first, second), float(signal), float(noise))
