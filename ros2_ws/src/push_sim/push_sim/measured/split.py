"""Which measurements the parameters are fitted to, and which are kept to judge the fit."""

import numpy as np
from numpy.typing import NDArray

from push_sim.measured.measured_data import MeasuredData

Rows = NDArray[np.intp]


def split(data: MeasuredData, seed: int) -> tuple[MeasuredData, MeasuredData]:
    """Two parts: to fit, and to judge.

    Half of the short pushes and half of each file of long pushes, drawn by the seed, are fitted.
    Of the runs it is the last by name, in the measured set the unperturbed one; a single run
    cannot be kept back, so it serves for both.
    """
    random = np.random.default_rng(seed)
    short = _halves(random, len(data.short)) if data.short else None
    long = {file: _halves(random, len(pushes)) for file, pushes in data.long.items()}
    runs = data.runs[-1:], data.runs[:-1] or data.runs
    parts = (
        MeasuredData(
            data.short.take(short[part]) if data.short and short else None,
            {file: pushes.take(long[file][part]) for file, pushes in data.long.items()},
            runs[part],
        )
        for part in (0, 1)
    )
    first, second = parts
    return first, second


def _halves(random: np.random.Generator, count: int) -> tuple[Rows, Rows]:
    order = random.permutation(count)
    return np.sort(order[: count // 2]), np.sort(order[count // 2 :])
