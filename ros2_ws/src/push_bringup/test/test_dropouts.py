"""What times without poses cost a lap, in process and so the same on every machine."""

from dataclasses import replace

import numpy as np
import pytest
from push_bringup.in_process.loop import InProcessCell, nanoseconds
from push_bringup.setup.cell_parameters import CellParameters, node_defaults
from push_gp.models.model_file import model_named
from push_mpc.loop.modes import FOLLOWING, MOVING, Mode
from push_mpc.plan.planning import planned
from push_node.stamps import to_seconds


@pytest.fixture(scope='module')
def lap():
    """Runs a lap on which no pose comes for some ticks, once a second; errors and end."""
    settings = node_defaults('irb120')
    settings['mpc_node'] = replace(settings['mpc_node'], track='line')
    settings['gp_server'] = replace(settings['gp_server'], model='analytical')
    parameters = CellParameters(*settings.values())

    def run(missing: int) -> tuple[float, float, Mode]:
        model = model_named('analytical', parameters.gp.slider)
        cell = InProcessCell(parameters, model, planned(parameters.mpc))
        errors = pushed(cell, missing)
        ended = cell.controller.mode
        cell.close()
        return float(np.mean(errors)), float(np.max(errors)), ended

    return run


def pushed(cell: InProcessCell, missing: int) -> list[float]:
    """Errors [m] of the true poses; without poses the controller goes on as the node does."""
    controller, plant = cell.controller, cell.plant
    cell.start()
    seen, cell._first = cell._first, None
    origin, errors, tick, lost, reference_time = nanoseconds(seen.time), [], 0, 0, 0.0
    while controller.mode in MOVING or controller.mode == Mode.STOPPING:
        tick += 1
        # none over the end of the track, where the run ends without a further pose
        due = tick % 100 == 0 and reference_time < controller.plan.duration - 0.3
        lost = missing if due else max(lost - 1, 0)
        now = to_seconds(nanoseconds(plant.time) - origin)
        if not lost:
            exposure = to_seconds(nanoseconds(seen.time) - origin)
            answer = controller.step(seen.object_pose, seen.tip_position, exposure, now)
            plant.command(answer.velocity, plant.time)
            if answer.mode in FOLLOWING and answer.reference_time > 0.0:
                reference_time = answer.reference_time
                reference, _ = controller.plan.at(reference_time)
                errors.append(np.hypot(*(seen.truth.object_pose[:2] - reference[:2])))
            controller.prepare_next()
        else:
            plant.command(controller.coast(now).velocity, plant.time)
        seen = plant.step_until_seen()
    return errors


@pytest.mark.parametrize('missing', [2, 5])
def test_dropouts_of_at_most_50_ms_once_a_second_cost_little(lap, missing) -> None:
    mean, _, _ = lap(0)
    with_dropouts, largest, ended = lap(missing)
    assert ended == Mode.DONE
    assert with_dropouts - mean < 0.3e-3
    assert largest < 5e-3


@pytest.mark.parametrize('missing', [20, 60])
def test_longer_ones_make_the_lap_longer_and_are_survived(lap, missing) -> None:
    with_dropouts, largest, ended = lap(missing)
    assert ended == Mode.DONE
    assert with_dropouts < 0.5e-3
    assert largest < 5e-3
