"""When the plant steps: on the wall clock (realtime) or on each command (lockstep)."""

import time
from collections.abc import Callable
from typing import Protocol

from push_core.geometry import Array
from push_node import interface
from push_node.publishers import GraphPublishers
from push_node.stamps import to_stamp
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rosgraph_msgs.msg import Clock as ClockMessage

from push_sim.plant import Observation, Plant

_PERIOD = round(Plant.period * 1e9)
_START = round(Plant.START * 1e9)
# a timer may fire this much before the period is over
_EARLY = _PERIOD // 20
_RESEND_PERIOD = 0.2


class Pace(Protocol):
    """Steps the plant and converts its time into message stamps."""

    late_frames: int
    """Exposures that were not published because the process woke up too late."""

    def restart(self, observation: Observation) -> None:
        """Starts again after a reset of the plant, which returned this observation."""

    def command(self, velocity: Array, stamp: int) -> None:
        """Takes a velocity (2,) [m/s] that answers the pose with a stamp [ns]."""

    def stamp(self, plant_time: float) -> int:
        """Message stamp [ns] of a plant time [s]."""


class RealtimePace:
    """Steps the plant every 10 ms; after a late wake-up it catches up and publishes the newest.

    The physics follows the steady clock and never slows down. Stamps come from the node's clock
    and are exactly 10 ms apart between two resets unless the sensor jitters.
    """

    def __init__(
        self,
        node: Node,
        plant: Plant,
        _publishers: GraphPublishers,
        publish: Callable[[Observation], None],
    ) -> None:
        self.late_frames = 0
        self._node = node
        self._plant = plant
        self._publish = publish
        clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(Plant.period, self._tick, clock=clock)
        self._set_origin()

    def restart(self, _observation: Observation) -> None:
        """Maps the restarted plant time onto the timer's grid."""
        self._set_origin()

    def command(self, velocity: Array, _stamp: int) -> None:
        """Passes on a velocity (2,) [m/s] with its time of arrival."""
        arrival = time.monotonic_ns() - self._origin
        self._plant.command(velocity, max(self._plant.time, (_START + arrival) * 1e-9))

    def stamp(self, plant_time: float) -> int:
        """The node's time [ns] at a plant time [s]."""
        return self._stamp_origin + round(plant_time * 1e9) - _START

    def _set_origin(self) -> None:
        since_last_tick = _PERIOD - int(self._timer.time_until_next_call())
        self._origin = time.monotonic_ns() - since_last_tick
        self._stamp_origin = int(self._node.get_clock().now().nanoseconds) - since_last_tick
        self._ticks = 0

    def _tick(self) -> None:
        due = (time.monotonic_ns() - self._origin + _EARLY) // _PERIOD
        if due <= self._ticks:
            return
        self.late_frames += due - self._ticks - 1
        newest: Observation | None = None
        while self._ticks < due:
            newest = self._plant.step() or newest
            self._ticks += 1
        if newest is not None:
            self._publish(newest)


class LockstepPace:
    """Publishes a pose and `/clock`, waits for the command that answers, and steps once.

    In a period without a picture, poses that are no numbers say so.

    An unanswered pose is published again until a command arrives: poses are best effort, and the
    controller may not be running yet.
    """

    late_frames: int = 0

    def __init__(
        self,
        node: Node,
        plant: Plant,
        publishers: GraphPublishers,
        publish: Callable[[Observation], None],
    ) -> None:
        self._plant = plant
        self._publishers = publishers
        self._publish = publish
        self._clock = publishers.of(interface.CLOCK)
        self._answered = False
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        node.create_timer(_RESEND_PERIOD, self._resend, clock=steady)

    def restart(self, observation: Observation) -> None:
        """Publishes the first observation after a reset."""
        self._show(observation)

    def command(self, velocity: Array, stamp: int) -> None:
        """Steps if this velocity (2,) [m/s] answers the current pose; ignores any other."""
        if stamp != self.stamp(self._shown.time):
            return
        self._answered = True
        self._publishers.step()
        self._plant.command(velocity, self._plant.time)
        self._show(self._plant.step() or self._plant.without_picture())

    def stamp(self, plant_time: float) -> int:
        """The plant time in nanoseconds: in lockstep the cell's clock is the plant's."""
        return round(plant_time * 1e9)

    def _show(self, observation: Observation) -> None:
        self._shown = observation
        self._clock.publish(ClockMessage(clock=to_stamp(self.stamp(self._plant.time))))
        self._publish(observation)

    def _resend(self) -> None:
        if not self._answered:
            self._show(self._shown)
        self._answered = False
