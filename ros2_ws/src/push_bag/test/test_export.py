"""Exported tables hold every value of a run, unrounded."""

import numpy as np
import pytest
from push_bag.commands.export import main
from push_bag.run.run_reader import read_run
from push_bag.score.tick_table import tick_table


def test_the_csv_has_a_row_for_each_tick_and_every_bit_of_its_numbers(record, tmp_path):
    def aside(pose, _time):
        return pose + np.array([0.0, 0.003, 0.0])

    run = record(path=lambda time: np.array([0.08 * time, 0.0, 0.0]), displaced=aside)
    assert main([str(run), '--csv', '-o', str(tmp_path / 'run.csv')]) == 0
    found = np.genfromtxt(tmp_path / 'run.csv', delimiter=',', names=True)
    expected = tick_table(read_run(run))
    assert found.dtype.names == tuple(expected)
    for name, column in expected.items():
        np.testing.assert_array_equal(found[name], column)
    tracked = ~np.isnan(found['tracking_error_m'])
    assert tracked.sum() == 150
    np.testing.assert_allclose(found['tracking_error_m'][tracked], 0.003)
    np.testing.assert_allclose(found['cross_track_m'][tracked], 0.003)
    np.testing.assert_allclose(np.diff(found['t_s']), 0.01)
    assert np.nanmax(found['solve_s']) < 1e-3


def test_the_parquet_file_holds_the_same_numbers(perfect, tmp_path):
    parquet = pytest.importorskip('pyarrow.parquet', reason='pyarrow is not installed')
    assert main([str(perfect), '--parquet', '-o', str(tmp_path / 'run.parquet')]) == 0
    found = parquet.read_table(tmp_path / 'run.parquet')
    for name, column in tick_table(read_run(perfect)).items():
        values = found[name].to_numpy()
        np.testing.assert_array_equal(values, column)


def test_a_bag_without_reference_and_a_missing_kind_are_refused(record, tmp_path, capsys):
    run = record(missing={'nominal_trajectory': {0}}, duration=0.2)
    assert main([str(run), '--csv', '-o', str(tmp_path / 'run.csv')]) == 2
    assert capsys.readouterr().err.count('\n') == 1
    with pytest.raises(SystemExit):
        main([str(run), '-o', str(tmp_path / 'run.csv')])


def test_of_several_starts_one_is_chosen(record_starts, tmp_path, capsys):
    bag = str(record_starts({}, ({'duration': 0.5}, (400, 400, 400))))
    words = [bag, '--csv', '-o', str(tmp_path / 'run.csv')]
    assert main(words) == 2
    assert 'the bag holds 2 starts; choose one with --start' in capsys.readouterr().err
    assert main([*words, '--start', '2']) == 0
    assert capsys.readouterr().out.startswith('91 rows')
