"""What a cell does, as seen from outside: true motion of the tip, commands, modes."""

import time
from dataclasses import dataclass, field

import numpy as np
from geometry_msgs.msg import TwistStamped
from push_core.geometry import Array
from push_msgs.msg import ControllerState, GroundTruth, NominalTrajectory
from push_node import interface
from push_node.stamps import to_nanoseconds
from rclpy.node import Node
from rclpy.qos import QoSProfile

_DEEP = QoSProfile(depth=1000)


@dataclass
class Seen:
    """What was seen of one case; stamps in ns.

    Attributes:
        tips: stamp, x, y [m] of the tip.
        commands: stamp, v_x, v_y [m/s].
        states: stamp, mode, reference time [s], distance from the reference [m].
        reasons: stop reasons, in order.
        longest_gap: largest time [s] in which this process itself did not run.
    """

    tips: list[tuple[int, float, float]] = field(default_factory=list)
    commands: list[tuple[int, float, float]] = field(default_factory=list)
    states: list[tuple[int, int, float, float]] = field(default_factory=list)
    reasons: list[str] = field(default_factory=list)
    longest_gap: float = 0.0


class Observer:
    """Listens to a cell."""

    def __init__(self, node: Node) -> None:
        self.seen = Seen()
        self.plan: NominalTrajectory | None = None
        self._awake = time.monotonic()
        interface.GROUND_TRUTH.subscription(node, self._on_truth, qos=_DEEP)
        interface.PUSHER_VELOCITY_CMD.subscription(node, self._on_command, qos=_DEEP)
        interface.CONTROLLER_STATE.subscription(node, self._on_state, qos=_DEEP)
        interface.NOMINAL_TRAJECTORY.subscription(node, self._on_plan)

    def forget(self) -> None:
        """Begins a new case."""
        self.seen = Seen()
        self._awake = time.monotonic()

    def awake(self) -> None:
        """Notes that this process runs; call it at least every 0.1 s."""
        now = time.monotonic()
        self.seen.longest_gap = max(self.seen.longest_gap, now - self._awake)
        self._awake = now

    @property
    def mode(self) -> int:
        """The mode that was published last."""
        return self.seen.states[-1][1] if self.seen.states else ControllerState.IDLE

    @property
    def reference_time(self) -> float:
        """Time of the reference [s], minus infinity before it begins."""
        return self.seen.states[-1][2] if self.seen.states else -np.inf

    def _on_truth(self, message: GroundTruth) -> None:
        x, y = message.tip.tolist()
        self.seen.tips.append((to_nanoseconds(message.header.stamp), x, y))

    def _on_command(self, message: TwistStamped) -> None:
        velocity = message.twist.linear
        stamp = to_nanoseconds(message.header.stamp)
        self.seen.commands.append((stamp, velocity.x, velocity.y))

    def _on_state(self, message: ControllerState) -> None:
        stamp = to_nanoseconds(message.header.stamp)
        distance = self._distance(message.state, message.reference_time)
        self.seen.states.append((stamp, message.mode, message.reference_time, distance))
        reason = message.stop_reason
        if reason and reason not in self.seen.reasons[-1:]:
            self.seen.reasons.append(reason)

    def _on_plan(self, message: NominalTrajectory) -> None:
        if 0 < len(message.time) == len(message.x) == len(message.y):
            self.plan = message

    def _distance(self, state: Array, time: float) -> float:
        plan = self.plan
        if plan is None or not np.isfinite(time) or not np.isfinite(state).all():
            return float('nan')
        x = np.interp(time, plan.time, plan.x) - state[0]
        y = np.interp(time, plan.time, plan.y) - state[1]
        return float(np.hypot(x, y))
