"""A run that learns: the nodes over DDS do what one process does, and it can be computed again."""

import json
from collections.abc import Callable

import numpy as np
from cell_command import Ended
from push_bag.replay.recompute import Changes, recomputed
from push_bag.run import RecordedRun

PLANT = ('-p', 'world.engine:=quasi_static', '-p', 'world.friction_pusher:=0.4')
LAPS = ('--track', 'circle', '--speed', '0.15', '--laps', '2', '--learn', *PLANT)


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
    assert len(models) == 2
    assert models == same_models
    np.testing.assert_array_equal(commands, same_commands)
    score = json.loads((runs[0].folder / 'score.json').read_text())
    first, second = score['per_lap']
    assert first['identified'] is None
    assert 0.25 < second['identified']['friction'] < 0.6
    assert second['truth_mean_mm'] < first['truth_mean_mm']
    for run in runs:
        again = recomputed(run.folder, Changes())
        assert (again.differs.sum(), again.skipped) == (0, 0)
