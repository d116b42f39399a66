"""The plant on the controller's clock: it waits for each command."""

from collections.abc import Callable

from push_core.geometry import Array
from push_node.stamps import to_stamp
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rosgraph_msgs.msg import Clock as ClockMessage

from push_sim.plant import Observation, Plant

_PATIENCE = 0.2


class LockstepPace:
    """Shows a pose, waits for the command that answers it, and advances one period.

    A pose that nobody answers is shown again and again, as messages may get lost: poses are best
    effort, and the controller may not be there yet.
    """

    late_frames: int = 0

    def __init__(self, node: Node, plant: Plant, publish: Callable[[Observation], None]) -> None:
        self._plant = plant
        self._publish = publish
        self._clock = node.create_publisher(ClockMessage, '/clock', 10)
        self._answered = False
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        node.create_timer(_PATIENCE, self._show_again, clock=steady)

    def restart(self, observation: Observation) -> None:
        """The plant was reset."""
        self._show(observation)

    def command(self, velocity: Array, stamp: int) -> None:
        """Advances if this velocity (2,) [m/s] answers the pose of now; others are late echoes."""
        if stamp != self.stamp(self._shown.time):
            return
        self._answered = True
        self._plant.command(velocity, self._plant.time)
        self._show(self._plant.step_until_seen())

    def stamp(self, plant_time: float) -> int:
        """The cell's time [ns] at a plant time [s]: they are the same."""
        return round(plant_time * 1e9)

    def _show(self, observation: Observation) -> None:
        self._shown = observation
        self._clock.publish(ClockMessage(clock=to_stamp(self.stamp(self._plant.time))))
        self._publish(observation)

    def _show_again(self) -> None:
        if not self._answered:
            self._show(self._shown)
        self._answered = False
