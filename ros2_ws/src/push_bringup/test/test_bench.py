"""The benchmarks: laps that are kept, and what is made of them."""

import json
import math
from dataclasses import replace
from typing import Any

import pytest
from push_bringup.bench import stopping
from push_bringup.bench.paper_page import paper_page
from push_bringup.bench.rows import (
    TIMES,
    AblationRow,
    MismatchRow,
    PaperRow,
    RealTimeRow,
    SizeRow,
    experiment_json,
    times_json,
)
from push_bringup.bench.tables import (
    ablation_rows,
    mismatch_rows,
    paper_rows,
    real_time_rows,
    time_ranges,
)
from push_bringup.bench.training_size import TrainingSet, chosen_rows
from push_bringup.bench.training_size_page import training_size_page
from push_bringup.commands import bench
from push_bringup.experiment.experiment import PAPER_MM, Experiment, LapJob
from push_bringup.experiment.lap import Lap, LapErrors, pushed
from push_bringup.experiment.lap_pool import LapStore, push_all
from push_bringup.in_process import InProcessCell
from push_bringup.mismatch.plants import PLANTS, PlantVariant
from push_core.common.strict_json import finite
from push_gp.models import model_named
from push_mpc.plan import planned

LINE = Experiment('line', 0.15)
JOB = LapJob(LINE, 'analytical', 'analytical', 'ideal', seed=0)
ROUNDS = (LapErrors(1.5, 4.0, 1.4), LapErrors(0.5, 1.0, 0.4, (0.2, 0.01), (31.0, 0.1)))
LAP = Lap(True, '', 1.5, 4.0, 1.4, 3.0, ((0.0, 1.0), (2.0, 3.0)), (1.0, 4.0), ROUNDS)


def with_error(millimetres: float, completed: bool = True) -> Lap:
    reason = '' if completed else 'left the face'
    rounds = tuple(LapErrors(each, each, 0.5 * each) for each in (millimetres, millimetres / 4))
    return Lap(completed, reason, millimetres, millimetres, 0.5 * millimetres, 3.0, (), (), rounds)


def test_a_lap_is_judged_by_its_error_and_its_end() -> None:
    lap = pushed(JOB)
    assert lap.completed
    assert 0.0 < lap.mean_mm < 0.12
    assert lap.mean_mm < lap.max_mm
    assert lap.path_mm[-1][0] == pytest.approx(500.0, abs=10.0)


def test_a_lap_that_stays_behind_is_not_completed() -> None:
    # the guard would end the run at 50 mm
    slow = {'sim_node.actuator.speed_limit': 0.05, 'guard.tracking_error': 0.1}
    lap = pushed(LapJob(LINE, 'analytical', 'analytical', 'ideal', 0, slow))
    assert not lap.completed
    assert lap.max_mm > 50.0


def test_finished_laps_outlive_the_process_and_a_torn_line(tmp_path) -> None:
    path = tmp_path / 'new' / 'laps.jsonl'
    LapStore(path).add(JOB, LAP)
    with path.open('a') as file:
        file.write('{"key": "cut o')
    again, other = LapStore(path), LapJob(LINE, 'analytical', 'analytical', 'ideal', seed=1)
    assert again.find(JOB) == LAP
    again.add(other, LAP)
    assert LapStore(path).find(other) == LAP
    assert LapStore(path, fresh=True).find(JOB) is None


def test_another_seed_model_or_override_is_another_lap(tmp_path) -> None:
    model = tmp_path / 'model.npz'
    keys = {JOB.key, LapJob(LINE, 'analytical', 'analytical', 'ideal', 1).key}
    keys.add(LapJob(LINE, 'analytical', 'analytical', 'ideal', 0, {'laps': 2}).key)
    for content in (b'one', b'other'):
        model.write_bytes(content)
        keys.add(LapJob(LINE, 'gp', str(model), 'ideal', 0).key)
    assert len(keys) == 5


def test_laps_that_are_there_are_not_pushed_again(tmp_path) -> None:
    store = LapStore(tmp_path / 'laps.jsonl')
    store.add(JOB, LAP)
    assert push_all([JOB, JOB], store, processes=1) == [LAP, LAP]


def test_the_table_tells_median_spread_and_completed_laps() -> None:
    laps = (with_error(1.0), with_error(2.0), with_error(4.0, completed=False))
    row = PaperRow(Experiment('eight', 0.08), 'gp', 'irb120', laps)
    values = row.as_json()
    assert (values['median_mm'], values['spread_mm'], values['completed']) == (2.0, 3.0, 2)
    assert values['truth_median_mm'] == 1.0
    assert values['paper_mm'] == PAPER_MM[row.experiment]['gp'] == 8.5
    assert '| 2 of 3 | 2.00 mm | 1.00 mm | 3.00 mm | 8.50 mm |' in paper_rows({'rows': [values]})
    assert 'eight 80 mm' in paper_page([row])


def test_a_size_tells_the_quartiles_of_the_laps_that_were_completed() -> None:
    laps = (*(with_error(error) for error in (1.0, 2.0, 3.0)), with_error(90.0, False))
    values = SizeRow(10, 'zero', 'random', laps).as_json()
    assert (values['draws'], values['completed'], values['median_mm']) == (4, 3, 2.0)
    assert values['quartiles_mm'] == [1.5, 2.5]
    nothing = SizeRow(5, 'zero', 'die', (with_error(9.0, completed=False),)).as_json()
    assert nothing['median_mm'] is nothing['quartiles_mm'] is None
    json.dumps([values, nothing], allow_nan=False)
    assert 'analytical controller' in training_size_page(
        [SizeRow(10, 'zero', 'random', laps)], LAP
    )


def test_nested_draws_of_one_seed_contain_each_other(pushes) -> None:
    small, large = (
        chosen_rows(pushes, TrainingSet(points, 'zero', 'random', 3)) for points in (5, 9)
    )
    assert set(small.tolist()) < set(large.tolist())


@pytest.mark.parametrize(
    ('arguments', 'fault'),
    [
        ([], 'WHAT'),
        (['tables'], 'tables'),
        (['table', '--seeds', '0'], '--seeds'),
        (['table', '--profile', 'rough'], 'rough'),
        (['table', '--model', 'none.npz'], 'none.npz'),
        (['data', '--draws', '0'], '--draws'),
        (['data', '--data', 'none.csv'], 'none.csv'),
        (['table', '--html', 'none/page.html'], 'none'),
        (['stopping', '--runs', '0'], '--runs'),
        (['mismatch', '--seeds', '0'], '--seeds'),
        (['mismatch', '--rows', 'moon'], 'moon'),
    ],
)
def test_a_wrong_command_is_one_line_and_status_2(
    arguments, fault, capsys, monkeypatch, tmp_path
) -> None:
    monkeypatch.chdir(tmp_path)
    try:
        status = bench.main(arguments)
    except SystemExit as ended:
        status = ended.code
    said = capsys.readouterr().err
    assert (status, said.count('\n')) == (2, 1)
    assert fault in said


def real_time_score(mean: float, completed: bool, solve: float) -> dict[str, Any]:
    tail = {'p50': solve, 'p99': 2.0 * solve, 'max': 3.0 * solve}
    return {
        'completed': completed,
        'tracking_error_mm': {'mean': mean},
        'deadline_misses': 3,
        **dict.fromkeys(TIMES, tail),
    }


def test_real_time_is_a_ratio_to_in_process_and_the_range_of_each_time() -> None:
    scores = (
        real_time_score(2.5, True, 0.25),
        real_time_score(2.0, True, 0.5),
        real_time_score(9.0, False, 0.125),
    )
    row = RealTimeRow(LINE, 'gp', (1.0, 2.0, 4.0), scores)
    values = row.as_json()
    assert (values['in_process_mm'], values['real_time_mm'], values['ratio']) == (2.0, 2.5, 1.25)
    assert '| 2 of 3 | 2.00 mm | 2.50 mm | 1.25 | 9 |' in real_time_rows({'rows': [values]})
    times = times_json('gp', [row])
    assert times['solve_ms'] == {'p50': [0.125, 0.5], 'p99': [0.25, 1.0], 'max': [0.375, 1.5]}
    assert '| gp | 3 | 0.12–0.50 | 0.25–1.00 |' in time_ranges({'times': [times]})


def test_an_ablation_names_laps_that_were_not_completed_or_never_tracked() -> None:
    laps = ((with_error(1.0),), (with_error(2.0, False),), (with_error(math.inf, False),))
    experiments = [Experiment('eight', 0.08), LINE, Experiment('eight', 0.08, 'normal')]
    results = {
        'experiments': [experiment_json(each) for each in experiments],
        'rows': [AblationRow('without it', laps).as_json()],
    }
    table = ablation_rows(finite(results))
    assert '| controller | eight 80 mm/s | line 150 mm/s | eight 80 mm/s, normal |' in table
    errors = '1.00 mm | 2.00 mm (0 of 1 laps) | never tracked (0 of 1 laps)'
    assert f'| without it | {errors} | 3 mm/s |' in table


def test_stopping_is_stated_as_median_and_largest() -> None:
    values = stopping.text([0.5, 0.75, 2.0])
    assert 'median 0.75 s, largest 2.00 s of 3 runs' in values


def test_a_mismatch_tells_the_error_of_the_laps_that_were_completed() -> None:
    laps = (with_error(1.0), with_error(3.0), with_error(90.0, completed=False))
    rows = [
        MismatchRow('rim', 'pressure at the rim', LINE, controller, laps[:count]).as_json()
        for controller, count in (('gp', 3), ('analytical', 2))
    ]
    assert (rows[0]['laps_mm'], rows[0]['completed'], rows[0]['learn']) == ([1.0, 0.25], 2, False)
    assert rows[0]['stop_reasons'] == ['left the face']
    table = mismatch_rows({'rows': rows})
    assert (
        '| rim | pressure at the rim | line 150 mm/s | 1.00 mm → 0.25 mm (2 of 3 runs) |' in table
    )
    lost = MismatchRow('rim', 'pressure at the rim', LINE, 'gp', laps[2:]).as_json()
    assert lost['laps_mm'] == [None]
    assert 'lost (0 of 1 laps)' in mismatch_rows({'rows': [lost]})


def test_a_run_learns_within_a_lap_what_its_plant_is_and_after_it_what_recurs() -> None:
    circle = Experiment('circle', 0.1)
    plant = {'world.engine': 'quasi_static', 'world.friction_pusher': 0.5}
    job = LapJob(circle, 'gp', 'analytical', 'ideal', 0, plant, laps=2, learn=True)
    taught, untaught = pushed(job), pushed(replace(job, learn=False))
    assert taught.completed
    first, second = taught.per_lap
    assert first.truth_mean_mm < 0.3 * untaught.per_lap[0].truth_mean_mm
    assert second.truth_mean_mm < 0.7 * first.truth_mean_mm
    assert untaught.per_lap[1].friction is None
    for lap in taught.per_lap:
        friction, uncertainty = lap.friction or (math.nan, math.nan)
        assert 0.3 < friction < 0.8
        assert 0.0 < uncertainty < 0.3


def test_after_a_bad_lap_the_next_is_driven_like_the_best(monkeypatch) -> None:
    monkeypatch.setattr('push_gp.learn.lap_learner.WORSE', 0.0)
    circle, plant = Experiment('circle', 0.2), {'world.engine': 'quasi_static'}
    job = LapJob(circle, 'gp', 'analytical', 'ideal', 0, plant, laps=4, learn=True)
    parameters = job.parameters()
    model = model_named('analytical', parameters.gp.slider)
    cell = InProcessCell(parameters, model, planned(parameters.mpc), learn=True)
    seen = []
    cell.run(lambda *_: seen.append(cell.controller.model_id))
    cell.close()
    first, second, third, fourth = (seen[round((lap + 0.9) / 4 * len(seen))] for lap in range(4))
    assert len({first, second, fourth}) == 3
    assert third == first


def test_every_plant_is_a_cell_and_each_is_another(tmp_path) -> None:
    jobs = [
        LapJob(plant.experiment, 'analytical', 'analytical', plant.profile, 0, plant.overrides)
        for plant in PLANTS.values()
    ]
    assert len({job.key for job in jobs}) == len(PLANTS)


def test_the_bench_pushes_its_rows_and_prints_them(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.setitem(PLANTS, 'home', PlantVariant('nothing', {'profile': 'ideal'}, LINE))
    page, options = tmp_path / 'page.html', ['--rows', 'home', '--controllers', 'analytical']
    work = ['--jobs', '1', '--laps-file', str(tmp_path / 'laps.jsonl'), '--html', str(page)]
    assert bench.main(['mismatch', *options, '--seeds', '1', *work, '--json']) == 0
    (row,) = json.loads(capsys.readouterr().out)['rows']
    assert (row['plant'], row['completed']) == ('home', 1)
    assert 0.0 < row['laps_mm'][0] < 0.2
    assert 'line 150 mm/s' in page.read_text()


def test_three_times_the_friction_that_the_model_has_learned_does_not_end_the_lap(
    model_file,
) -> None:
    # with so few pushes it comes back from 60 mm; the guard ends a run at 50 mm
    overrides = {**PLANTS['friction_0.6'].overrides, 'guard.tracking_error': 0.1}
    lap = pushed(
        LapJob(PLANTS['friction_0.6'].experiment, 'gp', str(model_file), 'irb120', 0, overrides)
    )
    assert lap.completed, lap.stop_reason
