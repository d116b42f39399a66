"""The numbers of the QP's stages at every sample of a plan, in the units of the solver.

Computed once for each plan and model, so that a tick only copies the stages of its horizon. The
solver's units are millimetres, hundredths of a radian, and units in which inputs at the usual
speeds are about one.
"""

from dataclasses import dataclass, replace

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array, rotation

from push_mpc.qp.preview import Preview

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
    """A stage of the horizon for each sample of the plan, in the solver's units.

    Attributes:
        space: the inputs.
        entries: of -A where `A_PATTERN` is set, then of -B (n, entries of the space).
        drift: (n, 4, 1 + 3); column 0: error of the nominal under the model's equations of
            motion; columns 1 to 3: its derivative by the disturbance.
        target: derivative of the target state and input by the disturbance (n, 4 + m, 3).
        low: lower bounds (n, 1 + k) on the deviation of p_y after the stage and of the limited
            combinations in it.
        high: upper bounds (n, 1 + k).
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
        """Converts linearised dynamics and bounds to the solver's units.

        Args:
            space: the inputs.
            preview: the linearised dynamics along the plan.
            limits: lower and upper bounds on the deviation of p_y [m] and of the limited
                combinations of the inputs, each (n, 1 + k).

        Raises:
            InputError: the model moves the object beyond all bounds.
        """
        a = preview.transition * (STATE_SCALE / STATE_SCALE[:, None])
        b = preview.effect * (space.scale / STATE_SCALE[:, None])
        entries = np.concatenate([a[:, A_PATTERN], b.reshape(-1, NX * space.size)], axis=-1)
        if not (np.isfinite(entries).all() and np.isfinite(preview.drift).all()):
            raise InputError('the model returned implausibly large displacement rates')
        low, high = _bounds(space, limits)
        scale = np.concatenate([STATE_SCALE, space.scale])[:, None]
        return cls(space, -entries, preview.drift / scale[:NX], preview.target / scale, low, high)

    def turned(self, angle: float) -> 'Stages':
        """The stages of the plan turned in the plane by an angle [rad].

        Of the states only x and y turn; A keeps their identity, and both have the same unit.
        """
        a, b = np.zeros((len(self), NX, NX)), self.entries[:, _A_ENTRIES:]
        a[:, A_PATTERN] = self.entries[:, :_A_ENTRIES]
        turn = rotation(angle)
        a[:, :2, 2:] = turn @ a[:, :2, 2:]
        effect = b.reshape(-1, NX, self.space.size).copy()
        effect[:, :2] = turn @ effect[:, :2]
        drift = self.drift.copy()
        drift[:, :2] = turn @ drift[:, :2]
        entries = np.concatenate([a[:, A_PATTERN], effect.reshape(b.shape)], axis=-1)
        return replace(self, entries=entries, drift=drift)

    def within(self, limits: tuple[Array, Array]) -> 'Stages':
        """The same stages with other limits, see `of`."""
        low, high = _bounds(self.space, limits)
        return replace(self, low=low, high=high)

    def __len__(self) -> int:
        return len(self.entries)

    def in_si_units(self, window: Array) -> tuple[Array, Array, Array, Array, tuple[Array, Array]]:
        """A, B, drift, target and limits in SI units, for the stages (N,) of a window."""
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


def _bounds(space: InputSpace, limits: tuple[Array, Array]) -> tuple[Array, Array]:
    """Limits in SI units as bounds in the solver's units."""
    low, high = limits
    return low / space.rows_scale, high / space.rows_scale
