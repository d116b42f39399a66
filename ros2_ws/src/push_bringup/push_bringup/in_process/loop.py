"""Plant and controller in one loop, without DDS, faster than real time."""

import time
from collections.abc import Callable

from push_core.common import RunError
from push_gp.models import PushModel
from push_mpc.loop import Controller, Mode, Tick, here_fault
from push_mpc.plan import Plan
from push_node.stamps import to_seconds
from push_sim.plant import Observation, Plant
from tqdm import tqdm

from push_bringup.in_process.school import School
from push_bringup.in_process.tables import tabulated
from push_bringup.setup import CellParameters

# a thread of the progress bar would take the Ctrl-C that the controller holds while it solves
tqdm.monitor_interval = 0
OnTick = Callable[[Observation | None, Tick, float], None]


class InProcessCell:
    """Plant and controller in one loop; the trajectory equals that of lockstep.

    Attributes:
        plant: world, robot and cameras.
        controller: commands the tip.
        school: lets every lap teach the next; None if nothing is learned.
    """

    def __init__(
        self, parameters: CellParameters, model: PushModel, plan: Plan, learn: bool = False
    ) -> None:
        """Makes plant and controller; the plan must be made from the same parameters."""
        mpc = parameters.mpc
        self.plant = Plant(parameters.sim, parameters.sim.slider)
        self.controller = Controller(mpc, mpc.slider, plan)
        self._sim, self._mpc = parameters.sim, mpc
        self._first: Observation | None = None
        self.school = School(self.controller, parameters, model) if learn else None
        if self.school is not None:
            self.school.use_lesson()
        else:
            table = tabulated(model, mpc.slider.side)
            self.controller.use(self.controller.prepare_model(table, model.info.model_id))

    def start(self) -> None:
        """Resets the plant and arms the controller.

        Raises:
            RunError: the plan cannot begin where the object lies.
        """
        self._first = seen = self._reset()
        if self._mpc.start_from != 'here':
            self.controller.arm()
            return
        fault = here_fault(
            self._mpc.slider,
            self._mpc.limits,
            self.controller.track_plan,
            seen.object_pose,
            seen.tip_position,
        )
        if fault:
            raise RunError(fault)
        self.controller.arm(seen.object_pose)

    def run(self, on_tick: OnTick) -> str:
        """Pushes once along the track, from a start of its own unless `start` was called.

        Args:
            on_tick: called with the observation of each period, None without one, the
                controller's tick and its duration [ms].

        Returns:
            Reason of an early stop, else an empty string.
        """
        if self._first is None:
            self.start()
        assert self._first is not None
        first, self._first = self._first, None
        observation: Observation | None = first
        origin = nanoseconds(first.time)
        while self.controller.mode not in (Mode.DONE, Mode.STOPPED, Mode.FAULT):
            started = time.perf_counter()
            if self.school is not None:
                self.school.use_lesson()
            now = to_seconds(nanoseconds(self.plant.time) - origin)
            if observation is None:
                tick = self.controller.coast(now)
            else:
                exposure = to_seconds(nanoseconds(observation.time) - origin)
                pose, tip = observation.object_pose, observation.tip_position
                tick = self.controller.step(pose, tip, exposure, now)
            on_tick(observation, tick, 1e3 * (time.perf_counter() - started))
            if self.school is not None and observation is not None:
                self.school.observe(observation, tick)
            self.controller.prepare_next()
            self.plant.command(tick.velocity, self.plant.time)
            observation = self.plant.step()
        if self.school is not None and self.controller.mode == Mode.DONE:
            self.school.finish()
        return self.controller.stop_reason

    def close(self) -> None:
        """Frees the physics server."""
        self.plant.close()

    def _reset(self) -> Observation:
        if self._mpc.start_from == 'here':
            placed = self._sim.start
            pose, tip = placed.object_pose, placed.tip_position(self._sim.slider)
        else:
            state = self.controller.plan.state[0]
            pose, tip = state[:3], self._mpc.slider.tip_position(state[:3], state[3])
        return self.plant.reset(pose, tip, self._sim.seed)


def nanoseconds(plant_time: float) -> int:
    """A plant time [s] in whole nanoseconds, as in the stamps of the topics."""
    return round(plant_time * 1e9)
