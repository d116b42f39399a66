"""The numbers of the quadratic program at every sample of a plan, as the solver wants them.

Made once for each plan and model, so that a tick only copies its window. The solver sees
millimetres, hundredths of a radian and, at the usual speeds, inputs of about one.
"""

from dataclasses import dataclass

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array

from push_mpc.qp.preview import Preview

NX = 4
STATE_SCALE = np.array([1e-3, 1e-3, 1e-2, 1e-3])
# where a transition can differ from 0: the world position enters no rate
A_PATTERN = np.array([[1, 0, 1, 1], [0, 1, 1, 1], [0, 0, 1, 1], [0, 0, 0, 1]], dtype=bool)
_A_ENTRIES = int(A_PATTERN.sum())


@dataclass(frozen=True)
class InputSpace:
    """What a controller chooses in every stage, and what of it is limited.

    Attributes:
        scale: unit in which the solver sees each input (m,).
        limited: the limited combinations of the inputs, in the solver's units (k, m).
        limited_scale: unit in which the solver sees each combination (k,).
    """

    scale: Array
    limited: Array
    limited_scale: Array

    @property
    def size(self) -> int:
        """Number of inputs m."""
        return self.scale.size

    @property
    def entries(self) -> int:
        """Numbers that describe the dynamics of one stage."""
        return _A_ENTRIES + NX * self.size

    @property
    def rows_scale(self) -> Array:
        """Units of the limited numbers of one stage: the next p_y, then the inputs' (1 + k,)."""
        return np.concatenate([STATE_SCALE[3:], self.limited_scale])


@dataclass(frozen=True)
class Stages:
    """Stages of the horizon, one for each sample at which it can have one; all scaled.

    Attributes:
        space: the inputs.
        entries: of -A by pattern, then of -B (n, entries of the space).
        drift: how the nominal itself misses the model's motion, then what a disturbance adds
            to that (n, 4, 1 + 3).
        target: where the best state and input are under a disturbance (n, 4 + m, 3).
        low: lowest deviation of p_y after the stage, of the limited inputs in it (n, 1 + k).
        high: highest ones (n, 1 + k).
    """

    space: InputSpace
    entries: Array
    drift: Array
    target: Array
    low: Array
    high: Array

    @classmethod
    def of(
        cls,
        space: InputSpace,
        preview: Preview,
        limits: tuple[Array, Array],
    ) -> 'Stages':
        """Scales the stages.

        Args:
            space: the inputs.
            preview: the linearised dynamics along the plan.
            limits: lowest and highest deviation of p_y [m] and of the limited combinations of
                the inputs, each (n, 1 + k).

        Raises:
            InputError: the model moves the object beyond all bounds.
        """
        a = preview.transition * (STATE_SCALE / STATE_SCALE[:, None])
        b = preview.effect * (space.scale / STATE_SCALE[:, None])
        entries = np.concatenate([a[:, A_PATTERN], b.reshape(-1, NX * space.size)], axis=-1)
        if not (np.isfinite(entries).all() and np.isfinite(preview.drift).all()):
            raise InputError('the model returned implausibly large displacement rates')
        low, high = (np.asarray(limit / space.rows_scale) for limit in limits)
        scale = np.concatenate([STATE_SCALE, space.scale])[:, None]
        return cls(space, -entries, preview.drift / scale[:NX], preview.target / scale, low, high)

    def __len__(self) -> int:
        return len(self.entries)

    def in_si_units(self, window: Array) -> tuple[Array, Array, Array, Array, tuple[Array, Array]]:
        """What `of` was given after the space, for the stages (N,) of a window."""
        transition = np.zeros((len(window), NX, NX))
        transition[:, A_PATTERN] = -self.entries[window, :_A_ENTRIES]
        effect = -self.entries[window, _A_ENTRIES:].reshape(-1, NX, self.space.size)
        return (
            transition * (STATE_SCALE[:, None] / STATE_SCALE),
            effect * (STATE_SCALE[:, None] / self.space.scale),
            self.drift[window] * STATE_SCALE[:, None],
            self.target[window] * np.concatenate([STATE_SCALE, self.space.scale])[:, None],
            (
                self.low[window] * self.space.rows_scale,
                self.high[window] * self.space.rows_scale,
            ),
        )
