"""What a tick brings, on its way out: the command, the record of the tick, the horizon."""

from geometry_msgs.msg import TwistStamped
from push_core.geometry import Array
from push_msgs.msg import ControllerState
from push_node import interface
from push_node.publishers import PUBLISHERS
from rclpy.duration import Duration
from rclpy.node import Node

from push_mpc.loop import Tick
from push_mpc.node import conversions
from push_mpc.node.horizon_message import HORIZON_EVERY, HorizonMessage
from push_mpc.qp import PlannedStates

FLUSH_TIMEOUT = 1.0  # [s] for the last command and state to arrive


class TickOutput:
    """Fills the same messages at each tick, without allocating, and publishes them.

    Attributes:
        ticks: that were told of.
    """

    def __init__(self, node: Node, mode: str, horizon: HorizonMessage) -> None:
        """Makes the publishers of a node in a mode, realtime or lockstep."""
        self.ticks = 0
        self._horizon = horizon
        self._command, self._state = TwistStamped(), ControllerState()
        self._command.header.frame_id = self._state.header.frame_id = 'world'
        self._outputs = PUBLISHERS[mode](node)
        self._commands = self._outputs.of(interface.PUSHER_VELOCITY_CMD)
        self._states = self._outputs.of(interface.CONTROLLER_STATE)
        self._horizons = self._outputs.of(interface.HORIZON)

    def command(self, velocity: Array, stamp: int) -> None:
        """Publishes a tip velocity (2,) [m/s] with the stamp [ns] of the pose that it answers."""
        conversions.set_stamp(self._command, stamp)
        conversions.fill_command(self._command, velocity)
        self.repeat_command()

    def repeat_command(self) -> None:
        """Publishes the last command again."""
        self._commands.publish(self._command)

    def state(
        self, tick: Tick, stamp: int, tick_ms: float, stop_reason: str, model_id: str
    ) -> None:
        """Publishes the record of a tick, with its stamp [ns] and its duration [ms]."""
        conversions.set_stamp(self._state, stamp)
        conversions.fill_state(self._state, tick)
        self._state.tick = self.ticks
        self._state.tick_ms = tick_ms
        self._state.stop_reason = stop_reason
        self._state.model_id = model_id
        self._states.publish(self._state)
        self.ticks += 1

    def horizon(self, planned: PlannedStates | None, stamp: int) -> None:
        """Publishes the planned states of one tick in HORIZON_EVERY, if there are any."""
        if planned is not None and self.ticks % HORIZON_EVERY == 0:
            self._horizons.publish(self._horizon.of(planned, stamp))

    def step(self) -> None:
        """Ends a tick; in lockstep waits now and then for subscribers that fall behind."""
        self._outputs.step()

    def flush(self) -> None:
        """Waits for the last command and state: a destroyed publisher drops what is under way."""
        for publisher in (self._commands, self._states):
            publisher.wait_for_all_acked(Duration(seconds=FLUSH_TIMEOUT))
