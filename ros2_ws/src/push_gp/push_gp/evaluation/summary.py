"""What a user reads after training."""

import math
from collections.abc import Iterator

from push_core.data import OUTPUTS, READABLE, PushSet, accuracy

from push_gp.models import GpModel

UNITS = ('mm', 'mm', 'deg')


def training_summary(model: GpModel, rest: PushSet | None) -> str:
    """A few lines about a model.

    Args:
        model: just trained.
        rest: pushes that it was not trained on, where there are any.
    """
    lines = [*_hyperparameters(model)]
    if rest is not None:
        lines.append(_errors(model, rest))
    return '\n'.join(lines)


def _hyperparameters(model: GpModel) -> Iterator[str]:
    yield f'{"":8}{"length p_y":>12}{"length beta":>14}{"signal":>13}{"noise":>13}'
    for name, process, scale, unit in zip(OUTPUTS, model.processes, READABLE, UNITS, strict=True):
        its = process.hyperparameters
        across, around = its.lengthscales[0] * 1e3, math.degrees(its.lengthscales[1])
        signal, noise = its.signal_std / scale, its.noise_std / scale
        yield (
            f'{name:8}{across:9.1f} mm{around:10.1f} deg{signal:9.3f} {unit:3}{noise:9.3f} {unit}'
        )


def _errors(model: GpModel, rest: PushSet) -> str:
    predicted, _ = model.evaluate(rest.p_y, rest.beta)
    told = accuracy(predicted, rest)
    dx, dy, dtheta = told.rmse / READABLE
    return (
        f'on the other {told.n} pushes: rmse {dx:.3f} mm, {dy:.3f} mm, {dtheta:.3f} deg; '
        f'NMSE {told.nmse_push_frame.mean():.4f} in the push frame'
    )
