"""Pushes one lap of the 8-track in this process, without ROS, and prints the tracking error."""

import numpy as np
from push_bringup import tabulated
from push_core import Slider
from push_gp import train
from push_mpc import Controller, Mode, Plan, mpc_settings, planned
from push_sim import Plant, collect_pushes, profile


def main() -> None:
    """Collects, trains, plans, pushes."""
    slider = Slider()
    model = train(collect_pushes(200, seed=0))
    plan = planned(mpc_settings('irb120'))
    controller = Controller(mpc_settings('irb120'), slider, plan)
    controller.use(controller.prepare_model(tabulated(model, slider.side), model.info.model_id))
    error = np.array(lap_errors(Plant(profile('irb120'), slider), controller, plan, slider))
    print(f'mean tracking error {1e3 * error.mean():.2f} mm, largest {1e3 * error.max():.2f} mm')


def lap_errors(plant: Plant, controller: Controller, plan: Plan, slider: Slider) -> list[float]:
    """Pushes once along the plan; distances [m] from the object to its reference."""
    start = plan.state[0]
    tip = slider.tip_position(start[:3], start[3])
    observation = plant.reset(start[:3], tip, seed=0)
    controller.arm()
    errors = []
    while controller.mode not in (Mode.DONE, Mode.STOPPED):
        seen = observation.object_pose, observation.tip_position
        tick = controller.step(*seen, exposure=observation.time, now=plant.time)
        if 0.0 < tick.reference_time <= plan.duration:
            reference, _ = plan.at(tick.reference_time)
            errors.append(float(np.hypot(*(observation.object_pose - reference[:3])[:2])))
        controller.prepare_next()
        plant.command(tick.velocity, plant.time)
        observation = plant.step_until_seen()
    return errors


if __name__ == '__main__':
    main()
