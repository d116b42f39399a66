"""A run that learns: the nodes over DDS do what one process does, and it can be computed again."""

import json
from collections.abc import Callable

import numpy as np
from cell_command import Ended
from push_bag.file import BagReader
from push_bag.replay.recompute import Changes, recomputed
from push_bag.run import RecordedRun
from push_bringup.in_process import recorded_lessons

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
