"""What the Gaussian processes are told to expect where no push was seen."""

from typing import TypeAlias

import numpy as np
from push_core.frames import Array

from push_gp.analytical_model import AnalyticalModel

MEAN_FUNCTIONS = ('zero', 'analytical')


class ZeroMean:
    """The paper's choice: the object stays where it is."""

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """See `PushModel.evaluate`; a zero that broadcasts would hide a wrong length."""
        return np.zeros((len(p_y), 3)), np.zeros((len(p_y), 3, 2))


MeanFunction: TypeAlias = ZeroMean | AnalyticalModel
"""The Gaussian processes learn what is left of the displacement over one of these."""
