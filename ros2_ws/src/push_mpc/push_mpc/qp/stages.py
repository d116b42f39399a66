"""Target and bounds of the QP's stages at every sample of a plan, in the units of the solver.

Computed once for each plan and model, so that a tick only copies the stages of its horizon. The
solver's units are millimetres, hundredths of a radian, and units in which inputs at the usual
speeds are about one.
"""

from dataclasses import dataclass, replace

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array

NX = 4
STATE_SCALE = np.array([1e-3, 1e-3, 1e-2, 1e-3])
# entries of A that can differ from 0: no rate depends on the world position
A_PATTERN = np.array([[1, 0, 1, 1], [0, 1, 1, 1], [0, 0, 1, 1], [0, 0, 0, 1]], dtype=bool)
_A_ENTRIES = int(A_PATTERN.sum())


@dataclass(frozen=True)
class InputSpace:
    """The inputs of a stage and their linear constraints.

    Attributes:
        scale: the solver's unit of each input (m,).
        limited: rows are the linear combinations of inputs that have bounds (k, m), in the
            solver's units.
        limited_scale: the solver's unit of each combination (k,).
        names: of the combinations, with their units.
    """

    scale: Array
    limited: Array
    limited_scale: Array
    names: tuple[str, ...]

    @property
    def size(self) -> int:
        """Number of inputs m."""
        return self.scale.size

    @property
    def entries(self) -> int:
        """How many entries of A and B one stage has."""
        return _A_ENTRIES + NX * self.size

    @property
    def rows_scale(self) -> Array:
        """The solver's units (1 + k,) of what has bounds in a stage: next p_y, combinations."""
        return np.concatenate([STATE_SCALE[3:], self.limited_scale])


@dataclass(frozen=True)
class Stages:
    """Target and bounds of a stage of the horizon for each sample of the plan, in solver units.

    Neither depends on where the plan lies.

    Attributes:
        space: the inputs.
        target: derivative of the target state and input by the disturbance (n, 4 + m, 3).
        low: lower bounds (n, 1 + k) on the deviation of p_y after the stage and of the limited
            combinations in it.
        high: upper bounds (n, 1 + k).
    """

    space: InputSpace
    target: Array
    low: Array
    high: Array

    @classmethod
    def of(cls, space: InputSpace, target: Array, limits: tuple[Array, Array]) -> 'Stages':
        """Converts targets and bounds to the solver's units.

        Args:
            space: the inputs.
            target: see `steady_shift`.
            limits: lower and upper bounds on the deviation of p_y [m] and of the limited
                combinations of the inputs, each (n, 1 + k).

        Raises:
            InputError: the model moves the object beyond all bounds.
        """
        if not np.isfinite(target).all():
            raise InputError('the model returned implausibly large displacement rates')
        low, high = _bounds(space, limits)
        scale = np.concatenate([STATE_SCALE, space.scale])[:, None]
        return cls(space, target / scale, low, high)

    def within(self, limits: tuple[Array, Array]) -> 'Stages':
        """The same stages with other limits, see `of`."""
        low, high = _bounds(self.space, limits)
        return replace(self, low=low, high=high)

    def __len__(self) -> int:
        return len(self.low)

    def in_si_units(self, window: Array) -> tuple[Array, tuple[Array, Array]]:
        """Target and limits in SI units, for the stages (N,) of a window."""
        scale = np.concatenate([STATE_SCALE, self.space.scale])[:, None]
        limits = (self.low[window], self.high[window])
        low, high = (each * self.space.rows_scale for each in limits)
        return self.target[window] * scale, (low, high)


def _bounds(space: InputSpace, limits: tuple[Array, Array]) -> tuple[Array, Array]:
    """Limits in SI units as bounds in the solver's units."""
    low, high = limits
    return low / space.rows_scale, high / space.rows_scale
