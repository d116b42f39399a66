"""A run that learns: the nodes over DDS do what one process does, and it can be computed again."""

import json
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from cell_command import Ended
from push_bag.file import BagReader
from push_bag.replay.recompute import Changes, recomputed
from push_bag.run import RecordedRun
from push_bringup.experiment import Experiment, LapJob
from push_bringup.in_process import InProcessCell, recorded_lessons
from push_gp.models import model_named
from push_mpc.loop import FOLLOWING, Tick
from push_mpc.plan import planned
from push_sim.plant import Observation, Perturbation, PerturbationKind, Plant
from push_sim.settings import SimSettings

PLANT = ('-p', 'world.engine:=quasi_static', '-p', 'world.friction_pusher:=0.4')
CIRCLE = ('--track', 'circle', '--speed', '0.15', *PLANT)
LAPS = (*CIRCLE, '--laps', '2', '--learn')


def driven(run: Ended) -> tuple[list[str], np.ndarray]:
    """Models in the order of their ticks, and the commands (n, 2) while the tip moved."""
    ticks = [each for each in RecordedRun(run.folder).ticks() if each.velocity is not None]
    moving = [each for each in ticks if each.velocity.any()]
    return [*dict.fromkeys(each.model_id for each in moving)], np.array(
        [each.velocity for each in moving]
    )


def test_lockstep_learns_as_one_process_does_and_is_computed_again_bit_for_bit(
    run_cell: Callable[..., Ended],
) -> None:
    runs = [run_cell(*LAPS, '--mode', mode) for mode in ('lockstep', 'inprocess')]
    assert [run.status for run in runs] == [0, 0], [run.err for run in runs]
    (models, commands), (same_models, same_commands) = (driven(run) for run in runs)
    assert len(models) > 2
    assert models == same_models
    np.testing.assert_array_equal(commands, same_commands)
    score = json.loads((runs[0].folder / 'score.json').read_text())
    first, second = score['per_lap']
    for lap in (first, second):
        assert 0.25 < lap['identified']['friction'] < 0.6
    assert second['truth_mean_mm'] < first['truth_mean_mm']
    # a run of one lap goes on from there
    further = run_cell(*CIRCLE, '--learn-from', str(runs[0].folder), '--mode', 'lockstep')
    (lap,) = json.loads((further.folder / 'score.json').read_text())['per_lap']
    last = recorded_lessons(BagReader(runs[0].folder))[-1]
    assert last.laps == 2
    assert driven(further)[0] == [last.lesson_id]
    assert lap['identified']['pushes'] == last.pushes
    assert lap['truth_mean_mm'] < first['truth_mean_mm']
    for run in (*runs, further):
        again = recomputed(run.folder, Changes())
        assert (again.differs.sum(), again.skipped) == (0, 0)


def kicked(plant: Plant, _settings: SimSettings) -> None:
    plant.perturb(Perturbation(PerturbationKind.TANGENTIAL, 0.02))


def moved(plant: Plant, _settings: SimSettings) -> None:
    """As by a hand, away from the tip."""
    plant.perturb(Perturbation(PerturbationKind.NORMAL, 0.03))


def rougher(plant: Plant, settings: SimSettings) -> None:
    plant.change(replace(settings, world=replace(settings.world, friction_pusher=0.4)))


@pytest.mark.parametrize('disturb', [kicked, moved, rougher])
def test_a_disturbed_lap_recovers_and_does_not_spoil_the_next(
    disturb: Callable[[Plant, SimSettings], None],
) -> None:
    laps, speed, plant = 3, 0.15, {'world.engine': 'quasi_static'}
    job = LapJob(Experiment('eight', speed), 'gp', 'analytical', 'irb120', 0, plant, laps, True)
    parameters = job.parameters()
    model = model_named('analytical', parameters.gp.slider)
    cell = InProcessCell(parameters, model, planned(parameters.mpc), learn=True)
    lap_time = cell.controller.plan.duration / laps
    times, errors = [], []

    def on_tick(seen: Observation | None, tick: Tick, _milliseconds: float) -> None:
        if seen is None or tick.mode not in FOLLOWING or tick.reference_time <= 0.0:
            return
        before = times[-1] if times else 0.0
        if before < 1.5 * lap_time <= tick.reference_time:
            disturb(cell.plant, parameters.sim)
        times.append(tick.reference_time)
        wanted = cell.controller.plan.at(tick.reference_time)[0][:2]
        errors.append(1e3 * float(np.hypot(*(seen.truth.object_pose[:2] - wanted))))

    assert not cell.run(on_tick)
    time, error = np.array(times), np.array(errors)
    recovered = time - 1.5 * lap_time > 0.6 / speed
    after = error[recovered & (time < 2.0 * lap_time)].mean(), error[time > 2.0 * lap_time].mean()
    print(disturb.__name__, 'lap 1', error[time < lap_time].mean(), 'after', after)
    assert max(after) < 0.5
