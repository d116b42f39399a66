"""The plant on the wall clock."""

import time
from collections.abc import Callable

from push_core.geometry import Array
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from push_sim.plant import Observation, Plant

_PERIOD = round(Plant.period * 1e9)
_START = round(Plant.START * 1e9)
# a timer may fire this much before the period is over
_EARLY = _PERIOD // 20


class RealtimePace:
    """Steps the plant once every 10 ms; after a late wake-up it catches up and shows the newest.

    Physics follows the steady clock and never slows down; the stamps are those of the node's
    clock, exactly 10 ms apart from one reset to the next unless the sensor jitters.
    """

    def __init__(self, node: Node, plant: Plant, publish: Callable[[Observation], None]) -> None:
        self.late_frames = 0
        self._node = node
        self._plant = plant
        self._publish = publish
        clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(Plant.period, self._tick, clock=clock)
        self._set_origin()

    def restart(self, _observation: Observation) -> None:
        """The plant was reset: its time starts anew, on the grid of the timer."""
        self._set_origin()

    def command(self, velocity: Array, _stamp: int) -> None:
        """Hands over a velocity (2,) [m/s] at the moment at which it arrived."""
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
