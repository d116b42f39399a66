"""The summary that `train` prints."""

import math
from collections.abc import Iterator

from push_core.common import plain_table
from push_core.data import OUTPUTS, READABLE, PushSet, accuracy

from push_gp.models import GpModel

UNITS = ('mm', 'mm', 'deg')


def training_summary(model: GpModel, rest: PushSet | None) -> str:
    """Hyperparameters of a trained model, and its errors on the pushes that it was not trained on.

    Args:
        model: just trained.
        rest: the other pushes of the file; None if there are none.
    """
    lines = plain_table(_hyperparameters(model))
    if rest is not None:
        lines.append(_errors(model, rest))
    return '\n'.join(lines)


def _hyperparameters(model: GpModel) -> Iterator[tuple[str, ...]]:
    yield '', 'length p_y', 'length beta', 'signal', 'noise'
    for name, process, scale, unit in zip(OUTPUTS, model.processes, READABLE, UNITS, strict=True):
        its = process.hyperparameters
        across, around = its.lengthscales[0] * 1e3, math.degrees(its.lengthscales[1])
        signal, noise = its.signal_std / scale, its.noise_std / scale
        yield (
            *(name, f'{across:.1f} mm', f'{around:.1f} deg'),
            *(f'{signal:.3f} {unit}', f'{noise:.3f} {unit}'),
        )


def _errors(model: GpModel, rest: PushSet) -> str:
    predicted, _ = model.evaluate(rest.p_y, rest.beta)
    errors = accuracy(predicted, rest)
    dx, dy, dtheta = errors.rmse / READABLE
    return (
        f'on the other {errors.n} pushes: rmse {dx:.3f} mm, {dy:.3f} mm, {dtheta:.3f} deg; '
        f'NMSE {errors.nmse_push_frame.mean():.4f} in the push frame'
    )
