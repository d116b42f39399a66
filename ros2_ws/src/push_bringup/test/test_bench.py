"""The benchmarks: laps that are kept, and what is made of them."""

import importlib
import json
import sys

import pytest
from push_bringup.bench import data as bench_data
from push_bringup.bench import realtime as bench_realtime
from push_bringup.bench import results as bench_results
from push_bringup.bench import stopping as bench_stopping
from push_bringup.bench import table as bench_table
from push_bringup.bench.data import Choice, Point
from push_bringup.bench.data_page import data_page
from push_bringup.bench.realtime import Agreement
from push_bringup.bench.table import Row
from push_bringup.bench.table_page import table_page
from push_bringup.commands import bench
from push_bringup.experiment.experiment import PAPER_MM, Experiment, Lap, LapJob, pushed
from push_bringup.experiment.lap_pool import LapStore, push_all

LINE = Experiment('line', 0.15)
JOB = LapJob(LINE, 'analytical', 'analytical', 'ideal', seed=0)
LAP = Lap(True, '', 1.5, 4.0, 3.0, ((0.0, 1.0), (2.0, 3.0)))


def with_error(millimetres: float, completed: bool = True) -> Lap:
    reason = '' if completed else 'left the face'
    return Lap(completed, reason, millimetres, millimetres, 3.0, ())


def test_a_lap_is_judged_by_its_error_and_its_end() -> None:
    lap = pushed(JOB)
    assert lap.completed
    assert 0.0 < lap.mean_mm < 4.0
    assert lap.mean_mm < lap.max_mm
    assert lap.path_mm[-1][0] == pytest.approx(500.0, abs=10.0)


def test_a_lap_that_stays_behind_is_not_completed() -> None:
    slow = {'sim_node.actuator.speed_limit': 0.05}
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
    row = Row(Experiment('eight', 0.08), 'gp', 'irb120', laps)
    told = row.as_json()
    assert (told['median_mm'], told['spread_mm'], told['completed']) == (2.0, 3.0, 2)
    assert told['paper_mm'] == PAPER_MM[row.experiment]['gp'] == 8.5
    assert '| 2 of 3 | 2.00 mm | 3.00 mm | 8.50 mm |' in bench_table.table([row])
    assert 'eight 80 mm' in table_page([row])


def test_a_size_tells_the_quartiles_of_the_laps_that_were_completed() -> None:
    laps = (*(with_error(error) for error in (1.0, 2.0, 3.0)), with_error(90.0, False))
    told = Point(10, 'zero', 'random', laps).as_json()
    assert (told['draws'], told['completed'], told['median_mm']) == (4, 3, 2.0)
    assert told['quartiles_mm'] == [1.5, 2.5]
    nothing = Point(5, 'zero', 'die', (with_error(9.0, completed=False),)).as_json()
    assert nothing['median_mm'] is nothing['quartiles_mm'] is None
    json.dumps([told, nothing], allow_nan=False)
    assert 'analytical controller' in data_page([Point(10, 'zero', 'random', laps)], LAP)


def test_nested_draws_of_one_seed_contain_each_other(pushes) -> None:
    small, large = (
        bench_data.chosen_rows(pushes, Choice(points, 'zero', 'random', 3)) for points in (5, 9)
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


def test_real_time_is_told_as_a_ratio_to_in_process() -> None:
    row = Agreement(LINE, 'gp', (1.0, 2.0, 4.0), (2.5, 2.0, 9.0), completed=2, deadline_misses=7)
    told = row.as_json()
    assert (told['in_process_mm'], told['real_time_mm'], told['ratio']) == (2.0, 2.5, 1.25)
    assert '| 2 of 3 | 2.00 mm | 2.50 mm | 1.25 | 7 |' in bench_realtime.table([row])


def test_stopping_is_told_by_median_and_largest() -> None:
    told = bench_stopping.text([0.5, 0.75, 2.0])
    assert 'median 0.75 s, largest 2.00 s of 3 runs' in told


def test_every_section_of_the_results_is_a_command_that_its_benchmark_takes(tmp_path) -> None:
    pushes = tmp_path / 'pushes.csv'
    arguments = bench_results.parser().parse_args(['--measured', str(pushes), '--fresh'])
    sections = bench_results.sections(arguments)
    assert {section.bench for section in sections} == {*bench.BENCHES} - {
        'results',
        'model',
        'stopping',
    }
    for section in sections:
        module = importlib.import_module(bench.BENCHES[section.bench][0])
        module.parser().parse_args(section.options)


def test_a_section_shows_its_command_and_what_that_printed(monkeypatch) -> None:
    def printed(options) -> int:
        sys.stdout.write('| a table |\n')
        return 1

    monkeypatch.setattr(bench_table, 'main', printed)
    options = ('--seeds', '5', '--laps-file', '/somewhere/laps.jsonl', '--fresh')
    told = bench_results.told(bench_results.Section('The rows', 'Words.', 'table', options))
    command = '`ros2 run push_bringup bench table --seeds 5`'
    assert told == f'## The rows\n\nWords.\n\n{command}\n\n| a table |\n'


def test_a_benchmark_that_could_not_run_leaves_no_results(monkeypatch, tmp_path, capsys) -> None:
    monkeypatch.setattr(bench_table, 'main', lambda _options: 2)
    page = tmp_path / 'results.md'
    assert bench_results.main(['-o', str(page)]) == 1
    assert 'bench table ended with status 2' in capsys.readouterr().err
    assert not page.exists()
