"""Each start of a controller in a bag is scored by itself; commands of others are noticed."""

import json

import numpy as np
import pytest
from push_bag.commands.score import main
from push_bag.report.report import REPORT_FILE, SCORE_FILE, write_results
from push_bag.run.starts import controllers, find_resets, find_starts
from push_bag.score.score import score_run
from push_bag.score.score_table import score_table
from push_msgs.msg import ControllerState

IDLE, ARMED, TRACKING, DONE = 0, 1, 2, 3
STOPPED, HOLDING, STOPPING = 4, 5, 7
LATER = (400, 400, 400)  # a start 4 s after the first one: log time, stamps, count of ticks


def off(shift):
    """Displaces the object by a distance [m]."""
    return lambda pose, _time: pose + np.array([shift, 0.0, 0.0])


def stopping(tick):
    """Stops during tracking."""
    return ARMED if tick < 20 else TRACKING if tick < 100 else STOPPED


def found_in(modes, tick=None, resets=()):
    """The starts of ticks with these modes, logged at 0, 1, 2 … ns."""
    modes = np.array(modes)
    tick = np.arange(modes.size) if tick is None else np.array(tick)
    return find_starts(np.arange(modes.size), modes, tick, np.array(resets, np.int64))


def starts_of(*modes, tick=None):
    """The (first, last) rows of each start of ticks with these modes."""
    found = found_in(modes, tick)
    return [(int(each.ticks[0]), int(each.ticks[-1])) for each in found]


def test_a_start_lasts_from_the_first_armed_tick_to_its_outcome():
    modes = (IDLE, ARMED, ARMED, TRACKING, DONE, DONE, ARMED, TRACKING, STOPPED, IDLE, IDLE)
    assert starts_of(*modes) == [(1, 5), (6, 8)]


def test_a_hold_does_not_divide_a_start():
    assert starts_of(ARMED, HOLDING, ARMED, TRACKING, HOLDING, TRACKING, DONE) == [(0, 6)]


def test_the_ramp_to_rest_is_of_the_start_and_no_outcome():
    assert starts_of(ARMED, TRACKING, STOPPING, STOPPING, DONE, DONE, IDLE) == [(0, 5)]


def test_a_stop_before_the_first_start_is_not_of_it():
    assert starts_of(STOPPED, IDLE, ARMED, TRACKING, DONE) == [(2, 4)]


def test_poses_from_before_a_reset_or_after_one_are_not_of_the_start():
    modes = (IDLE, STOPPED, IDLE, ARMED, TRACKING, DONE, DONE, IDLE, ARMED, TRACKING, STOPPED)
    windows = [(each.begin, each.end) for each in found_in(modes, resets=[1, 2, 6, 10])]
    assert windows == [(2, 6), (6, 10)]
    assert [(each.begin, each.end) for each in found_in(modes)] == [(0, 8), (8, 2**63 - 1)]


def test_a_reset_is_where_stamps_begin_anew_not_where_two_poses_changed_order():
    stamps = np.array([10, 20, 30, 40, 60, 50, 70, 10, 10, 20, 30])
    assert find_resets(np.arange(100, 111), stamps).tolist() == [107]
    assert find_resets(np.zeros(0, np.int64), np.zeros(0, np.int64)).size == 0


def test_a_stop_after_the_end_is_no_outcome():
    assert starts_of(ARMED, TRACKING, DONE, STOPPED, IDLE) == [(0, 2)]


def test_a_controller_that_is_started_again_begins_a_new_start():
    modes, tick = (ARMED, TRACKING, TRACKING, ARMED, TRACKING, DONE), (90, 91, 92, 0, 1, 2)
    assert starts_of(*modes, tick=tick) == [(0, 2), (3, 5)]


def test_two_controllers_at_once_are_told_apart_by_their_counts():
    tick = np.array([500, 501, 7, 502, 8, 503, 9])
    assert controllers(tick).tolist() == [0, 0, 1, 0, 1, 0, 1]


def test_a_controller_keeps_its_number_when_it_reaches_the_count_of_an_earlier_one():
    tick = np.concatenate([np.arange(1000), np.arange(1500)])
    assert set(controllers(tick)[1000:].tolist()) == {1}


def test_ticks_without_a_count_are_of_one_controller():
    assert not controllers(np.zeros(50, np.int64)).any()


@pytest.mark.parametrize(
    'shifts',
    [LATER, (400, 0, 400), (400, 400, 0), (100_000, 100_000, 400)],
    ids=['later', 'after a reset of the clock', 'of a new controller', 'after a long rest'],
)
def test_each_start_has_its_own_errors_and_outcome(record_starts, shifts):
    further = ({'displaced': off(1e-3)}, shifts)
    score = score_run(record_starts({'displaced': off(4e-3), 'modes': stopping}, further))
    first, second = score['starts']
    assert [each['completed'] for each in (first, second)] == [False, True]
    assert first['tracking_error_mm']['mean'] == pytest.approx(4.0)
    assert second['tracking_error_mm']['mean'] == pytest.approx(1.0)
    assert second['deadline_misses'] == 0
    assert second['duration_s'] == pytest.approx(1.5)
    assert {name: score[name] for name in second} == second


def test_the_reason_of_a_stop_is_that_of_its_start(record_starts):
    stopped = {'modes': stopping, 'stop_reason': 'no pose for 510 ms'}
    score = score_run(record_starts(stopped, ({}, LATER)))
    assert [each['stop_reason'] for each in score['starts']] == ['no pose for 510 ms', None]


def test_a_bag_with_one_start_has_no_list(perfect):
    assert 'starts' not in score_run(perfect)


@pytest.fixture
def two(record_starts):
    """A bag with starts at 4 and 1 mm."""
    return str(record_starts({'displaced': off(4e-3)}, ({'displaced': off(1e-3)}, LATER)))


def test_the_table_lists_the_starts(two, capsys):
    assert main([two]) == 0
    lines = [line.split()[:4] for line in capsys.readouterr().out.splitlines()]
    assert lines[1:3] == [[two, 'start', '1', 'yes'], [two, 'start', '2', 'yes']]


def test_one_start_can_be_chosen(two, capsys):
    assert main([two, '--start', '1', '--json']) == 0
    score = json.loads(capsys.readouterr().out)
    assert score['tracking_error_mm']['mean'] == pytest.approx(4.0)
    assert 'starts' not in score
    assert main([two, '--start', '3']) == 2
    assert f'{two}: there is no start 3: the bag holds 2' in capsys.readouterr().err


def test_a_bound_holds_for_each_start_or_the_chosen_one(two, capsys):
    assert main([two, '--fail-above', 'mean=2']) == 1
    assert f'tracking_error_mm.mean is 4 in {two} start 1' in capsys.readouterr().err
    assert main([two, '--fail-above', 'mean=2', '--start', '2']) == 0


def test_two_starts_can_be_compared(two, capsys):
    assert main([two, '--compare']) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert ['tracking_error_mm.mean', '4', '1', '-3'] in lines


def test_score_and_report_of_a_run_hold_every_start(record_starts):
    folder = record_starts({'displaced': off(4e-3)}, ({'displaced': off(1e-3)}, LATER))
    write_results(folder)
    assert len(json.loads((folder / SCORE_FILE).read_text())['starts']) == 2
    assert '<h1>2 runs</h1>' in (folder / REPORT_FILE).read_text()


def test_each_lap_has_its_errors(record):
    def second_lap_worse(pose, time):
        return pose + np.array([0.001 if time <= 0.75 else 0.003, 0.0, 0.0])

    score = score_run(record(displaced=second_lap_worse, truth=lambda pose, _: pose, laps=2))
    assert score['per_lap'] == [
        pytest.approx({'mean_mm': 1.0, 'max_mm': 1.0, 'truth_mean_mm': 1.0, 'identified': None}),
        pytest.approx({'mean_mm': 3.0, 'max_mm': 3.0, 'truth_mean_mm': 3.0, 'identified': None}),
    ]
    assert 'each lap                mean 1.00  3.00  mm' in score_table(score)


def test_each_lap_has_what_was_identified_when_it_ended(record):
    lessons = ((-9.0, 0, 0.3, 0.0), (0.8, 200, 0.2, 0.0), (1.3, 300, 0.4, 1e-3))
    score = score_run(record(laps=3, lessons=lessons))
    first, second, third = (lap['identified'] for lap in score['per_lap'])
    assert first is None
    assert second == pytest.approx(
        {
            'friction': 0.2,
            'friction_std': 0.02,
            'support_radius_mm': 30.0,
            'support_radius_std_mm': 0.6,
            'pushes': 200,
        }
    )
    assert (third['friction'], third['pushes']) == (0.4, 300)
    text = score_table(score)
    assert (
        'identified              friction 0.400 +- 0.040, support radius 30.00 +- 0.60 mm' in text
    )
    assert '3 laps, gp, learning' in text


def test_a_lap_that_was_not_begun_is_not_listed(record):
    (lap,) = score_run(record(modes=stopping, laps=2))['per_lap']
    assert lap == {'mean_mm': pytest.approx(0.0), 'max_mm': pytest.approx(0.0)} | {
        'truth_mean_mm': None,
        'identified': None,
    }


@pytest.mark.parametrize(
    'foreign',
    [lambda tick: [(3_000_000, 0.05)] if tick == 80 else [], lambda tick: [(0, 0.05)]],
    ids=['that answer no pose', 'of a second controller'],
)
def test_commands_of_another_publisher_are_the_reason(record, foreign):
    score = score_run(record(foreign=foreign))
    assert score['completed'] is False
    assert 'commands of another publisher on pusher_velocity_cmd' in score['reasons']['completed']
    assert score_table(score).splitlines()[0].startswith('completed               no: ')


def test_a_command_that_is_sent_again_is_no_other_publisher(record):
    assert score_run(record(foreign=lambda tick: [(0, 0.0)]))['completed'] is True


def test_commands_of_ticks_that_were_not_received_are_no_other_publisher(record):
    score = score_run(record(missing={'controller_state': {60, 61, 62}}))
    assert score['completed'] is True
    assert score['messages']['/controller_state']['lost'] == 3


def test_another_publisher_before_the_start_does_not_count(record):
    def idle_at_first(tick):
        if tick < 15:
            return IDLE
        return ARMED if tick < 20 else TRACKING if tick <= 181 else DONE

    def early(tick):
        return [(3_000_000, 0.05)] if tick < 10 else []

    assert score_run(record(foreign=early, modes=idle_at_first))['completed'] is True


def test_the_modes_named_here_are_those_of_the_message():
    for name in ('IDLE', 'ARMED', 'TRACKING', 'DONE', 'STOPPED', 'HOLDING'):
        assert getattr(ControllerState, name) == globals()[name]
