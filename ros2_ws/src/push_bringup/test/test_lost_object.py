"""How far an object goes astray before its run ends, in process, with the guard's default."""

import numpy as np
import pytest
from push_bringup.experiment.experiment import Experiment, LapJob
from push_bringup.experiment.lap import pushed
from push_bringup.in_process.loop import InProcessCell
from push_gp.models.model_file import model_named
from push_mpc.loop.modes import FOLLOWING
from push_mpc.plan.planning import planned

LARGEST_DEVIATION = 0.05  # [m]
BRAKING = 0.005  # [m] that the object goes on aside while the tip comes to rest


def lap(track: str, speed: float, controller: str, **overrides: float) -> LapJob:
    kicked = Experiment(track, speed, 'tangential')
    return LapJob(kicked, controller, 'analytical', 'irb120', 0, overrides)


def deviations(cell: InProcessCell) -> tuple[list[float], list[float]]:
    """Of the true object [m]: while it follows the plan, and from where that was left."""
    following, stopping, reference = [], [], np.zeros(2)

    def on_tick(observation, tick, _milliseconds) -> None:
        nonlocal reference
        follows = tick.mode in FOLLOWING and tick.reference_time > 0.0
        if follows:
            reference = cell.controller.plan.at(tick.reference_time)[0][:2]
        away = float(np.hypot(*(observation.truth.object_pose[:2] - reference)))
        (following if follows else stopping).append(away)

    assert 'from its reference' in cell.run(on_tick)
    return following, stopping[-1:]


@pytest.mark.parametrize(('track', 'share'), [('line', 0.2), ('circle', 0.45)])
def test_a_speed_limit_that_makes_the_plan_unfollowable_drives_it_at_most_50_mm_aside(
    track, share
) -> None:
    parameters = lap(track, 0.15, 'gp', tangential_speed_limit=share * 0.15).parameters()
    model = model_named('analytical', parameters.gp.slider)
    cell = InProcessCell(parameters, model, planned(parameters.mpc))
    following, (rest,) = deviations(cell)
    cell.close()
    assert 0.04 < max(following) <= LARGEST_DEVIATION
    assert rest < LARGEST_DEVIATION + BRAKING


def test_a_lap_that_finds_back_is_not_ended() -> None:
    friction = {'world.friction_pusher': 0.6}
    done = pushed(lap('eight', 0.08, 'analytical', **friction))
    assert (done.completed, done.max_mm > 20.0) == (True, True)
