"""A plan moved rigidly, so that it begins where the object lies."""

from dataclasses import dataclass, replace

import numpy as np
from push_core.geometry import Array, rotation

from push_mpc.plan.nominal import Plan


@dataclass(frozen=True)
class Placement:
    """A rigid motion of the plane, as the pose of the object before and after it.

    Attributes:
        origin: (3,) start of the plan along the track [m, m, rad].
        target: (3,) where it begins instead.
    """

    origin: Array
    target: Array

    @property
    def turn(self) -> float:
        """Angle [rad] by which the plan is turned."""
        return float(self.target[2] - self.origin[2])

    def of(self, plan: Plan) -> Plan:
        """The plan moved; its inputs are in the body frame and stay.

        A state that is the origin becomes the target to the last bit.
        """
        state = plan.state.copy()
        state[:, :2] = self.target[:2] + (state[:, :2] - self.origin[:2]) @ rotation(self.turn).T
        state[:, 2] = self.target[2] + (state[:, 2] - self.origin[2])
        return replace(plan, state=np.ascontiguousarray(state))
