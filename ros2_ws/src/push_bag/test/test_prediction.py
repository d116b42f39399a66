"""What the report draws of predictions, of the tip's motion and of the estimated model error."""

import struct

import numpy as np
import pytest
from push_bag.file.bag_writer import BagWriter
from push_bag.file.message_types import Definition
from push_bag.file.reader import BagReader
from push_bag.report.prediction import disturbances, prediction_errors, tip_velocities
from push_bag.report.reported_run import reported_runs
from push_bag.report.time_figure import ERROR, ROWS, time_figure
from push_bag.run.run_reader import read_run
from push_bag.score.score import score_series
from push_report.figure_style import robust_limit


def figure_of(run):
    return time_figure(reported_runs([(run, score_series(run))]))


def test_a_right_prediction_has_no_error(perfect):
    run = read_run(perfect)
    time, errors = prediction_errors(run, run.reference)
    assert time.size > 100
    assert time[0] > 0.12
    # the object moves on a circle between two poses; the lead is measured along its chord
    assert errors.max() < 2e-5


def test_a_prediction_2_mm_beside_what_came_has_an_error_of_2_mm(record):
    run = read_run(record(predicted=lambda pose: pose + np.array([0.0, 0.002, 0.0])))
    _, errors = prediction_errors(run, run.reference)
    assert errors == pytest.approx(np.full(errors.size, 2e-3), abs=3e-5)


def test_the_tip_pushes_with_the_velocity_of_the_object(record, paths):
    run = read_run(record(path=paths['line']))
    time, velocity = tip_velocities(run)
    inside = (time > 0.05) & (time < 1.4)
    assert velocity[inside] == pytest.approx(np.tile([0.08, 0.0], (inside.sum(), 1)), abs=1e-9)


def test_the_estimated_model_error_is_that_of_the_ticks(perfect):
    time, rates = disturbances(read_run(perfect))
    assert time.size == len(rates) > 100
    assert rates == pytest.approx(np.tile([0.01, -0.02, 0.3], (time.size, 1)))


def test_a_bag_of_an_earlier_version_has_no_estimate_and_the_same_score(perfect, tmp_path):
    reader, estimate = BagReader(perfect), struct.pack('<3d', 0.01, -0.02, 0.3)
    records = list(reader.records())
    with BagWriter(tmp_path / 'earlier', reader.facts, {}) as writer:
        for name, each in reader.topics.items():
            kept = [line for line in each.schema.splitlines() if 'disturbance' not in line]
            definition = Definition('\n'.join(kept), '')
            writer.add_topic(name, each.type_name, each.qos, definition)
        for each in records:
            data = each.data.replace(estimate, b'')
            writer.write(each.topic.name, data, each.log_ns, each.publish_ns, each.sequence)
    run = read_run(tmp_path / 'earlier')
    assert np.isnan(disturbances(run)[1]).all()
    assert score_series(run) == score_series(read_run(perfect))
    assert 'turn' in {trace.name for trace in figure_of(run).data}


def test_a_few_large_values_do_not_set_a_scale():
    values = np.concatenate([np.full(95, 0.2), np.full(5, 30.0)])
    assert robust_limit(values, 0.3) == pytest.approx(0.4)
    assert robust_limit(np.array([0.2, 0.3, 0.8]), 0.5) == pytest.approx(0.8)
    assert robust_limit(np.array([0.1]), 0.5) == 0.5
    assert robust_limit(np.array([np.nan]), 0.5) == 0.5


def test_a_perturbation_does_not_flatten_the_axis_of_the_error(record):
    def kicked(pose, time):
        size = 0.03 if 0.5 < time < 0.55 else 0.001 + 0.0005 * np.sin(20 * time)
        return pose + np.array([size, 0.0, 0.0])

    figure = figure_of(read_run(record(displaced=kicked)))
    assert ROWS[ERROR - 1][0] == 'error [mm]'
    assert figure.layout.yaxis.range[1] < 8.0


def test_the_rows_of_velocity_prediction_and_model_error_have_lines(perfect):
    names = {trace.name for trace in figure_of(read_run(perfect)).data}
    assert {'measured tip', 'prediction error', 'model error along the push', 'turn'} <= names
