"""`gp_server` with predictions that are silent, late, nonsense or poison on request."""

import sys
import time
from dataclasses import replace
from pkgutil import resolve_name
from typing import Any

import numpy as np
from push_gp.server import ModelServer

from push_bringup.faults.sick.ailment import ailment
from push_bringup.graph import MODULES

SLOW = 0.3  # [s]
_predict = ModelServer.predict


def sick_predict(server: ModelServer, *arguments: Any, **options: Any) -> Any:
    """See `ModelServer.predict`."""
    how = ailment()
    while how == 'silent':
        time.sleep(0.05)
        how = ailment()
    if how == 'late':
        time.sleep(SLOW)
    prediction = _predict(server, *arguments, **options)
    if how == 'nonsense':
        return replace(prediction, mean=np.full_like(prediction.mean, np.nan))
    if how == 'huge':
        return replace(prediction, mean=1e300 * np.ones_like(prediction.mean))
    if how == 'short':
        return replace(prediction, mean=prediction.mean[: len(prediction.mean) // 2])
    if how == 'poison':
        mirror = np.array([1.0, -1.0, -1.0])
        return replace(
            prediction,
            mean=prediction.mean * mirror,
            jacobian=prediction.jacobian * mirror[:, None],
        )
    return prediction


if __name__ == '__main__':
    setattr(ModelServer, 'predict', sick_predict)  # noqa: B010  mypy knows the healthy one
    sys.exit(resolve_name(f'{MODULES["gp_server"]}:main')())
