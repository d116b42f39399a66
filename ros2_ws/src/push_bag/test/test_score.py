"""Bags with known errors score exactly those errors."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped
from push_bag.commands.score import main
from push_bag.file.bag_writer import BagWriter
from push_bag.report.report import write_results
from push_bag.run import read_run
from push_bag.run.series import STATE_COLUMNS
from push_bag.score.score import score_run
from push_bag.score.score_table import score_table
from push_bag.score.timing import pauses
from push_core.common.errors import InputError
from push_core.common.strict_json import json_text
from push_msgs.msg import ControllerState
from rclpy.serialization import serialize_message


def circling(pose, time):
    """3 mm from the reference, on a circle round it."""
    return pose + np.array([0.003 * math.cos(5 * time), 0.003 * math.sin(5 * time), 0.0])


def test_a_perfect_run_scores_zero_and_is_completed(perfect):
    score = score_run(perfect)
    assert score['completed'] is True
    assert score['tracking_error_mm'] == pytest.approx(
        dict.fromkeys(('mean', 'rms', 'p95', 'max', 'mean_after_start'), 0.0), abs=1e-9
    )
    assert score['duration_s'] == pytest.approx(1.5)
    assert score['contact_losses'] == 0
    assert score['deadline_misses'] == 0


def test_a_circle_of_3_mm_about_the_reference_scores_3_mm(record):
    score = score_run(record(displaced=circling))
    figures = score['tracking_error_mm']
    assert figures == pytest.approx(dict.fromkeys(figures, 3.0), abs=1e-9)
    assert 2.9 < score['cross_track_mm']['max'] <= 3.0 + 1e-9


def test_a_true_pose_4_mm_beside_a_perfect_measurement_scores_4_mm(record):
    def beside(pose, _time):
        return pose + np.array([0.0, 0.004, 0.1])

    score = score_run(record(truth=beside))
    assert score['truth'] == pytest.approx(dict.fromkeys(score['tracking_error_mm'], 4.0))
    assert score['tracking_error_mm']['max'] == pytest.approx(0.0, abs=1e-9)
    assert 'error of the true pose  mean 4.00  rms 4.00' in score_table(score)


def test_a_true_pose_on_the_reference_scores_zero_however_wrong_the_measurement(record, paths):
    score = score_run(record(displaced=circling, truth=lambda _, time: paths['circle'](time)))
    assert score['truth'] == pytest.approx(dict.fromkeys(score['truth'], 0.0), abs=1e-9)
    assert score['tracking_error_mm']['mean'] == pytest.approx(3.0)


def test_a_bag_without_ground_truth_scores_null_and_exceeds_any_bound_on_it(perfect, capsys):
    score = score_run(perfect)
    assert score['truth'] is None
    assert 'none: the bag holds no ground truth' in score_table(score)
    assert main([str(perfect), '--fail-above', 'truth.mean=100']) == 1
    assert 'has no truth.mean' in capsys.readouterr().err


def test_a_lag_of_50_ms_scores_4_mm_along_the_path_and_none_across(record, paths):
    lagging = record(path=paths['line'], displaced=lambda _, time: paths['line'](time - 0.05))
    score = score_run(lagging)
    assert score['tracking_error_mm']['mean'] == pytest.approx(0.05 * 80.0, abs=1e-9)
    assert score['cross_track_mm']['max'] == pytest.approx(0.0, abs=1e-9)


def test_an_offset_to_the_left_is_a_positive_cross_track_error(record, paths):
    def left(pose, _time):
        return pose + np.array([0.0, 0.002, 0.0])

    figures = score_run(record(path=paths['line'], displaced=left))['cross_track_mm']
    assert figures == pytest.approx({'mean': 2.0, 'rms': 2.0, 'max': 2.0})


def test_cross_track_on_a_curve_is_the_distance_from_the_arc(record):
    def outwards(pose, _time):
        return pose + 0.005 * np.array([math.sin(pose[2]), -math.cos(pose[2]), 0.0])

    figures = score_run(record(displaced=outwards))['cross_track_mm']
    # the polyline of 0.8 mm chords lies up to 0.5 um inside the arc
    assert figures['mean'] == pytest.approx(-5.0, abs=1e-3)


def test_a_turned_object_scores_its_heading_error(record):
    def turned(pose, _time):
        return pose + np.array([0.0, 0.0, math.radians(-4.0)])

    figures = score_run(record(displaced=turned))['heading_error_deg']
    assert figures == pytest.approx({'mean': 4.0, 'rms': 4.0, 'max': 4.0})


def test_the_start_is_left_out_of_mean_after_start(record, paths):
    def late(pose, time):
        return pose + np.array([0.0, 0.010 if time <= 0.15 else 0.001, 0.0])

    figures = score_run(record(path=paths['line'], displaced=late))['tracking_error_mm']
    assert figures['mean_after_start'] == pytest.approx(1.0)
    assert figures['mean'] == pytest.approx((15 * 10.0 + 135 * 1.0) / 150)


def test_seven_missing_messages_are_seven_lost(record):
    missing = {'object_pose': {40, 41, 90}, 'controller_state': {60, 61, 62, 150}}
    messages = score_run(record(missing=missing))['messages']
    assert messages['/object_pose']['lost'] == 3
    assert messages['/controller_state']['lost'] == 4
    assert sum(counts['lost'] for counts in messages.values()) == 7


def test_without_sequence_numbers_losses_are_counted_by_stamps(record):
    messages = score_run(record(missing={'object_pose': {40, 41, 90}}, numbered=False))['messages']
    assert messages['/object_pose']['lost'] == 3
    assert messages['/pusher_pose']['lost'] == 0
    assert messages['/model_info']['lost'] is None


def test_messages_that_were_never_published_are_missing_stamps_and_not_lost(record):
    counts = score_run(record(unanswered=(100, 101)))['messages']['/pusher_velocity_cmd']
    assert (counts['missing_stamps'], counts['lost']) == (2, 0)


def test_late_and_missing_commands_are_deadline_misses(record):
    run = record(
        command_delay_ns=lambda tick: 12_000_000 if tick in (100, 101) else 1_500_000,
        unanswered=(150, 151, 152),
    )
    score = score_run(run)
    assert score['deadline_misses'] == 5
    assert score['pose_to_command_ms']['max'] == pytest.approx(12.0)
    assert score['pose_to_command_ms']['p50'] == pytest.approx(1.5)


def test_intervals_without_contact_are_counted_once_each(record):
    def gap(time):
        return 0.002 if 0.5 <= time <= 0.8 or 1.2 <= time <= 1.21 else 0.0

    assert score_run(record(gap=gap))['contact_losses'] == 2


def test_limits_are_counted_by_name(record):
    bits = ControllerState.LIMITED_SPEED | ControllerState.LIMITED_ACCELERATION
    score = score_run(record(limited=lambda tick: bits if 100 <= tick < 103 else 0))
    unused = dict.fromkeys(('not_finite', 'workspace', 'dead_band'), 0)
    assert score['limited'] == {**unused, 'speed': 3, 'acceleration': 3}


@pytest.mark.parametrize(
    'spoiled',
    [
        {'gap': lambda _time: 0.0015},
        {'displaced': lambda pose, _time: pose + np.array([0.051, 0.0, 0.0])},
        {'modes': lambda tick: 2 if 20 <= tick < 150 else 4},
        {'modes': lambda tick: 2},
    ],
    ids=['off the face', 'far from the end', 'stopped', 'never done'],
)
def test_a_run_that_does_not_end_well_is_not_completed(record, spoiled):
    assert score_run(record(**spoiled))['completed'] is False


def test_a_run_that_never_tracked_has_nulls_and_no_nan(record):
    score = score_run(record(modes=lambda _tick: ControllerState.ARMED))
    assert score['tracking_error_mm']['mean'] is None
    assert score['solve_ms']['p99'] is None
    assert 'NaN' not in json_text(score)


def test_facts_and_reference_name_the_run(perfect):
    score = score_run(perfect)
    assert (score['profile'], score['seed'], score['mode']) == ('irb120', 7, 'realtime')
    assert (score['track'], score['controller'], score['laps']) == ('eight', 'gp', 1)
    assert score['model'] == {'points': 200, 'hash': 'abc123' * 8, 'kind': 'gp'}


def test_the_results_hold_the_same_score_as_json(perfect):
    score = write_results(perfect)
    assert json.loads((perfect / 'score.json').read_text()) == score


def test_score_prints_one_json_object_or_a_table(record, capsys):
    folder = record(missing={'object_pose': {50}})
    assert main([str(folder), '--json']) == 0
    assert json.loads(capsys.readouterr().out)['completed'] is True
    assert main([str(folder)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ['completed', 'yes']
    assert lines[-1].startswith('1 of ')
    assert lines[-1].endswith('messages lost; /object_pose 1')


def test_the_results_state_that_the_recorder_died(record):
    folder = record(duration=0.4)
    assert write_results(folder, 'recorder was killed')['stop_reason'] == 'recorder was killed'
    assert json.loads((folder / 'score.json').read_text())['stop_reason'] == 'recorder was killed'


def test_a_bag_of_two_cells_is_not_scored_as_one(tmp_path):
    with BagWriter(tmp_path / 'mixed', {}, {}) as bag:
        for name in ('/left/object_pose', '/right/object_pose'):
            bag.add_topic(name, 'geometry_msgs/msg/PoseStamped', '')
            bag.write(name, serialize_message(PoseStamped()), 1, 1)
    with pytest.raises(InputError, match='two cells'):
        score_run(tmp_path / 'mixed')


def test_a_bag_without_a_reference_cannot_be_scored(record):
    with pytest.raises(InputError, match='no nominal trajectory'):
        score_run(record(missing={'nominal_trajectory': {0}}))


def test_a_run_in_one_process_has_no_time_from_pose_to_command(record):
    score = score_run(record(facts={'mode': 'inprocess'}, unanswered=(100,)))
    assert score['pose_to_command_ms']['p50'] is None
    assert score['deadline_misses'] == 1


def test_the_stop_reason_of_the_cell_precedes_that_of_the_controller(record):
    score = score_run(record(stop_reason='no pose for 510 ms', end_reason='sim_node ended'))
    assert score['stop_reason'] == 'sim_node ended'


def test_the_stop_reason_of_the_controller_counts_if_the_cell_gives_none(record):
    assert score_run(record(stop_reason='no pose for 510 ms'))['stop_reason'] == (
        'no pose for 510 ms'
    )


def test_the_cell_gives_the_reason_for_a_controller_that_died(record):
    score = score_run(record(end_reason='mpc_node ended with killed by signal 9'))
    assert score['stop_reason'] == 'mpc_node ended with killed by signal 9'


def test_a_run_whose_reference_does_not_move_is_not_completed(record):
    assert score_run(record(path=lambda _time: np.zeros(3)))['completed'] is False


def test_pauses_are_told_apart_from_holds(perfect) -> None:
    run = read_run(perfect)
    assert pauses(run) == {'count': 0, 'total_s': 0.0, 'longest_s': 0.0}
    waits, values = run.following.copy(), run.states.values.copy()
    time = values[:, STATE_COLUMNS.index('reference_time')]
    first = int(np.flatnonzero(waits)[0])
    # the reference waits for 0.2 s, later for 0.3 s in two parts of one pause
    for tick, seconds in ((first + 20, 0.2), (first + 60, 0.1), (first + 61, 0.2)):
        time[tick:] -= seconds
    found = pauses(replace(run, states=replace(run.states, values=values)))
    assert found['count'] == 2
    assert found['total_s'] == pytest.approx(0.5)
    assert found['longest_s'] == pytest.approx(0.3)
