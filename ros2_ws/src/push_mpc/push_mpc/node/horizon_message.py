"""The predicted horizon as one message that is filled in place, without allocation per tick."""

from array import array

import numpy as np
from push_msgs.msg import Horizon
from push_node.stamps import to_stamp

from push_mpc.qp import PlannedStates

HORIZON_EVERY = 5  # ticks, 20 Hz: enough for a viewer


class HorizonMessage:
    """Converts planned states to a message."""

    def __init__(self, steps: int, step: float) -> None:
        """Allocates the message.

        Args:
            steps: N, length of the horizon.
            step: time between its states [s].
        """
        self._states, self._scratch = np.zeros((2, steps + 1, 4))
        nothing = array('d', bytes(8 * (steps + 1)))
        message = self._message = Horizon(step=step, x=nothing, y=nothing, theta=nothing)
        self._message.header.frame_id = 'world'
        # views of the message's own buffers: the constructor copies its arguments
        self._columns = [np.frombuffer(each) for each in (message.x, message.y, message.theta)]

    def of(self, planned: PlannedStates, stamp: int) -> Horizon:
        """The message for a stamp [ns]; valid until the next call, which fills the same one."""
        planned.write(self._states, self._scratch)
        for column, values in zip(self._columns, self._states.T, strict=False):
            column[:] = values
        self._message.header.stamp = to_stamp(stamp)
        return self._message
