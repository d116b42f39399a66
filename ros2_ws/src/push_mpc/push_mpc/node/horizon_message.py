"""The planned horizon as one message that is filled in place: nothing grows with the horizon."""

from array import array

import numpy as np
from push_msgs.msg import Horizon
from push_node.stamps import to_stamp

from push_mpc.qp import PlannedStates

HORIZON_EVERY = 5  # ticks; an eye needs no more


class HorizonMessage:
    """Makes messages of planned states."""

    def __init__(self, steps: int, step: float) -> None:
        """Makes the message.

        Args:
            steps: N, length of the horizon.
            step: time between its states [s].
        """
        self._states, self._scratch = np.zeros((2, steps + 1, 4))
        nothing = array('d', bytes(8 * (steps + 1)))
        told = self._message = Horizon(step=step, x=nothing, y=nothing, theta=nothing)
        self._message.header.frame_id = 'world'
        # the message's own numbers, which are copies of what it was given
        self._columns = [np.frombuffer(each) for each in (told.x, told.y, told.theta)]

    def of(self, planned: PlannedStates, stamp: int) -> Horizon:
        """The message for a stamp [ns]; the next call fills the same one."""
        planned.write(self._states, self._scratch)
        for column, values in zip(self._columns, self._states.T, strict=False):
            column[:] = values
        self._message.header.stamp = to_stamp(stamp)
        return self._message
