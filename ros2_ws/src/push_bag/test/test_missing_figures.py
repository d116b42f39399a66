"""A score says why a figure is missing, and states those that the rest of the run gives."""

import math

import numpy as np
import pytest
from push_bag.commands.export import main as export
from push_bag.commands.score import main
from push_bag.file.bag_writer import BagWriter
from push_bag.file.reader import BagReader
from push_bag.report.report import write_results
from push_bag.score.score import score_run
from push_bag.score.score_table import score_table
from push_core.common.errors import InputError
from rclpy.serialization import deserialize_message, serialize_message

POSE = '/object_pose'


def unchanged(_message):
    """Leaves a message as it is."""


@pytest.fixture
def rewritten(perfect, tmp_path):
    """Writes the perfect run again with other names of topics, or changed poses."""

    def write(names=(), change=unchanged, topic=POSE, leave_out=()):
        names, reader = dict(names), BagReader(perfect)
        records = list(reader.records())
        kinds = {each.topic.name: type(each.message()) for each in records}
        with BagWriter(tmp_path / 'other', reader.facts, {}) as writer:
            for name, each in reader.topics.items():
                if name not in leave_out:
                    writer.add_topic(names.get(name, name), each.type_name, each.qos)
            for each in records:
                data, name = each.data, each.topic.name
                if name in leave_out:
                    continue
                if name == topic:
                    message = deserialize_message(data, kinds[name])
                    change(message)
                    data = serialize_message(message)
                times = each.log_ns, each.publish_ns, each.sequence
                writer.write(names.get(name, name), data, *times)
        return tmp_path / 'other'

    return write


def oriented(x, y, z, w):
    """A change of the orientation of every pose."""

    def change(message):
        turn = message.pose.orientation
        turn.x, turn.y, turn.z, turn.w = x, y, z, w

    return change


def test_poses_that_are_no_number_are_counted_and_the_others_scored(record):
    def lost(pose, time):
        return pose * math.nan if time in (0.5, 0.51) else pose + np.array([0.003, 0.0, 0.0])

    score = score_run(record(displaced=lost))
    assert score['tracking_error_mm']['max'] == pytest.approx(3.0)
    assert score['completed'] is True
    assert score['left_out'] == {
        # the driver of the tip of these runs computes it from the pose
        'object_pose': {'of': 191, 'not_finite': 2, 'no_heading': 0},
        'pusher_pose': {'of': 191, 'not_finite': 2, 'no_heading': 0},
    }
    assert 'left out                2 of 191 on object_pose: not a number' in score_table(score)


def test_a_run_that_ends_with_lost_poses_is_judged_by_the_last_known_one(record):
    score = score_run(record(displaced=lambda pose, time: pose * (math.nan if time > 1.4 else 1)))
    assert score['completed'] is True
    assert score['duration_s'] == pytest.approx(1.4)


def test_poses_that_are_all_no_number_are_the_reason(record):
    score = score_run(record(displaced=lambda pose, _time: pose * math.nan))
    reason = 'no pose on object_pose is a number (all 191 are NaN)'
    for name in ('tracking_error_mm', 'cross_track_mm', 'heading_error_deg', 'completed'):
        assert score['reasons'][name] == reason
    assert score['completed'] is None


def test_a_topic_of_another_name_is_named_with_status_1(rewritten, capsys):
    run = str(rewritten({POSE: '/vicon/box'}))
    reason = (
        'the bag holds no topic object_pose; of its type geometry_msgs/msg/PoseStamped it holds '
        '/vicon/box'
    )
    assert main([run]) == 1
    captured = capsys.readouterr()
    assert captured.out.splitlines()[0] == f'completed               not known: {reason}'
    assert captured.err.count('\n') == 1
    assert reason in captured.err


def test_the_json_has_the_reason_too(rewritten, capsys):
    assert main([str(rewritten({POSE: '/box'})), '--json']) == 1
    assert '"tracking_error_mm": "the bag holds no topic object_pose;' in capsys.readouterr().out


@pytest.mark.parametrize(
    ('topic', 'figure'),
    [
        ('/pusher_pose', 'contact_losses'),
        ('/controller_state', 'solve_ms'),
        ('/controller_state', 'completed'),
        ('/controller_state', 'deadline_misses'),
        ('/pusher_velocity_cmd', 'pose_to_command_ms'),
        ('/pusher_velocity_cmd', 'deadline_misses'),
        ('/model_info', 'model'),
    ],
)
def test_each_topic_that_is_missing_is_the_reason_for_its_figures(rewritten, topic, figure):
    score = score_run(rewritten({topic: '/arm/other'}))
    assert score['reasons'][figure].startswith(f'the bag holds no topic {topic[1:]}; of its type')
    assert 'it holds /arm/other' in score['reasons'][figure]


def test_a_topic_without_messages_is_the_reason(rewritten):
    score = score_run(rewritten(leave_out=(POSE,)))
    assert score['reasons']['tracking_error_mm'] == 'the bag holds no topic object_pose'


def test_a_reference_of_another_name_is_named(rewritten):
    with pytest.raises(InputError, match=r'nothing to score; of its type .* it holds /plan'):
        score_run(rewritten({'/nominal_trajectory': '/plan'}))


def test_stamps_of_another_clock_are_the_reason(rewritten):
    def later(message):
        message.header.stamp.sec += 3600

    score = score_run(rewritten(change=later))
    assert 'is stamped while the controller followed' in score['reasons']['tracking_error_mm']
    assert '+3599.' in score['reasons']['tracking_error_mm']


def test_tip_poses_of_another_time_leave_the_tracking_error(rewritten):
    def shifted(message):
        message.header.stamp.sec += 3600

    score = score_run(rewritten(change=shifted, topic='/pusher_pose'))
    assert score['tracking_error_mm']['max'] == pytest.approx(0.0, abs=1e-9)
    assert score['contact_losses'] is None
    assert 'no pose on pusher_pose is stamped while' in score['reasons']['contact_losses']


@pytest.mark.parametrize(
    'quaternion',
    [(0, 0, 0, 0), (0, 0, 0, 100.0), (0, 0, 0.5, 0.5), (1.0, 0, 0, 0), (math.nan, 0, 0, 1.0)],
    ids=['never set', 'in percent', 'not normalised', 'w first', 'not a number'],
)
def test_an_orientation_that_is_no_rotation_gives_no_heading(rewritten, quaternion):
    score = score_run(rewritten(change=oriented(*map(float, quaternion))))
    assert score['heading_error_deg'] == {'mean': None, 'rms': None, 'max': None}
    assert 'unit quaternion' in score['reasons']['heading_error_deg']
    assert score['completed'] is None
    assert score['tracking_error_mm']['max'] == pytest.approx(0.0, abs=1e-9)
    assert score['left_out']['object_pose'] == {'of': 191, 'not_finite': 0, 'no_heading': 191}


def test_a_quaternion_rounded_to_three_digits_is_a_rotation(rewritten):
    def rounded(message):
        turn = message.pose.orientation
        turn.z, turn.w = round(turn.z, 3), round(turn.w, 3)

    score = score_run(rewritten(change=rounded))
    assert score['heading_error_deg']['max'] < 0.1
    assert score['left_out'] == {}


def test_a_run_that_never_tracked_says_so(record, capsys):
    run = record(modes=lambda _tick: 1)
    assert main([str(run)]) == 1
    assert 'never followed the reference' in capsys.readouterr().err


def test_the_results_of_a_run_without_figures_are_written(rewritten):
    folder = rewritten(change=oriented(0.0, 0.0, 0.0, 0.0))
    assert write_results(folder)['completed'] is None
    assert 'not known whether completed' in (folder / 'report.html').read_text()


def test_a_loss_that_is_not_known_exceeds_any_bound(record, capsys):
    run = record(numbered=False)
    assert main([str(run), '--fail-above', 'lost=1000']) == 1
    captured = capsys.readouterr()
    assert 'has no lost' in captured.err
    assert 'not known of ' in captured.out.splitlines()[-1]


def test_reference_times_that_are_no_number_are_left_out_or_the_reason(rewritten, tmp_path):
    def sometimes(message):
        if message.tick % 2:
            message.reference_time = math.nan

    score = score_run(rewritten(change=sometimes, topic='/controller_state'))
    assert score['tracking_error_mm']['max'] == pytest.approx(0.0, abs=1e-3)


def test_a_controller_without_reference_times_is_the_reason(rewritten):
    def never(message):
        message.reference_time = math.nan

    score = score_run(rewritten(change=never, topic='/controller_state'))
    assert 'states no reference time' in score['reasons']['tracking_error_mm']


def test_a_reference_that_is_no_number_is_refused(rewritten):
    def spoilt(message):
        message.x[3] = math.nan

    with pytest.raises(InputError, match='times or poses that cannot be'):
        score_run(rewritten(change=spoilt, topic='/nominal_trajectory'))


@pytest.mark.parametrize('topic', ['controller_state', 'nominal_trajectory'])
def test_export_names_the_topic_that_is_missing(rewritten, tmp_path, capsys, topic):
    run = str(rewritten({f'/{topic}': '/arm/other'}))
    assert export([run, '--csv', '-o', str(tmp_path / 'run.csv')]) == 2
    error = capsys.readouterr().err
    assert f'no topic {topic}; of its type' in error
    assert 'it holds /arm/other' in error
