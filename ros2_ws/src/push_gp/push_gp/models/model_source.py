"""A model by what a user calls it: the path of a model file, or `analytical`."""

from pathlib import Path

from push_core.physics import Slider

from push_gp.models.analytical_model import ANALYTICAL, NOMINAL_DISTANCE, AnalyticalModel
from push_gp.models.model import PushModel
from push_gp.models.model_file import load_model


def model_named(
    name: str, slider: Slider | None = None, distance: float = NOMINAL_DISTANCE
) -> PushModel:
    """The model.

    Args:
        name: path of a model file, or 'analytical'.
        slider: of the analytical model; default: the measured square.
        distance: travel of the pusher [m] that one answer of the analytical model covers.

    Raises:
        InputError: there is no such model file, or it is no good one.
    """
    if name == ANALYTICAL:
        return AnalyticalModel(slider or Slider(), distance)
    return load_model(Path(name))
