"""What times without poses cost a lap, in process and so the same on every machine."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest
from push_bringup.in_process.loop import InProcessCell, nanoseconds
from push_bringup.setup.cell_parameters import CellParameters, node_defaults
from push_gp.models.model_file import model_named
from push_mpc.loop.modes import FOLLOWING, MOVING, Mode
from push_mpc.plan.planning import planned
from push_node.stamps import to_seconds

AT_REST = 50  # ticks after the end of a run

Due = Callable[[int, float], bool]
"""Whether poses are lost from a tick on, by its number and the time [s] left of the reference."""


@pytest.fixture(scope='module')
def new_cell():
    """Makes a cell on a line, in process."""
    settings = node_defaults('irb120')
    settings['mpc_node'] = replace(settings['mpc_node'], track='line')
    settings['gp_server'] = replace(settings['gp_server'], model='analytical')
    parameters = CellParameters(*settings.values())

    @contextmanager
    def made() -> Iterator[InProcessCell]:
        model = model_named('analytical', parameters.gp.slider)
        cell = InProcessCell(parameters, model, planned(parameters.mpc))
        yield cell
        cell.close()

    return made


@pytest.fixture(scope='module')
def lap(new_cell):
    """Runs a lap on which no pose comes for some ticks, once a second; errors and end."""

    def run(missing: int) -> tuple[float, float, Mode]:
        with new_cell() as cell:
            # none over the end of the track, which would make the lap shorter
            errors = pushed(cell, missing, lambda tick, left: tick % 100 == 0 and left > 0.3)
            return float(np.mean(errors)), float(np.max(errors)), cell.controller.mode

    return run


@pytest.fixture(scope='module')
def way_past_the_end(new_cell):
    """Runs a lap with one pause; how far past the end of the reference the object rests [m]."""

    def run(missing: int, left: float) -> float:
        pauses = iter([True])
        with new_cell() as cell:
            pushed(cell, missing, lambda _, now: now <= left and next(pauses, False))
            for _ in range(AT_REST):
                seen = cell.plant.step_until_seen()
            end, _ = cell.controller.plan.at(cell.controller.plan.duration)
            assert cell.controller.mode == Mode.DONE
            return float(seen.truth.object_pose[0] - end[0])

    return run


def pushed(cell: InProcessCell, missing: int, due: Due, *, runs_on: bool = True) -> list[float]:
    """Errors [m] of the true poses; without poses the controller goes on as the node does.

    Unless it does not run on itself: then no commands are sent.
    """
    controller, plant = cell.controller, cell.plant
    cell.start()
    seen, cell._first = cell._first, None
    origin, errors, tick, lost, reference_time = nanoseconds(seen.time), [], 0, 0, 0.0
    while controller.mode in MOVING or controller.mode == Mode.STOPPING:
        tick += 1
        left = controller.plan.duration - reference_time
        lost = missing if due(tick, left) else max(lost - 1, 0)
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
        elif runs_on:
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


@pytest.mark.parametrize(('missing', 'left'), [(9, 0.02), (12, 0.1), (40, 0.05)])
def test_a_pause_over_the_end_of_the_track_takes_the_object_no_further(
    way_past_the_end, missing, left
) -> None:
    assert abs(way_past_the_end(missing, left) - way_past_the_end(0, 0.0)) < 0.3e-3


def test_after_the_driver_has_braked_the_reference_goes_on_from_where_the_object_lies(
    new_cell,
) -> None:
    with new_cell() as cell:
        errors = pushed(cell, 8, lambda tick, _: tick == 200, runs_on=False)
        assert cell.controller.mode == Mode.DONE
        assert max(errors) < 3e-3
