"""A recorded and scored run, in lockstep and in real time, as readers not of ours see it, too.

How well a run in real time tracks depends on the machine: `bench realtime` measures it. Here
stands what holds of such a run however late its nodes were.
"""

import json
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cell_command import PATIENT, Ended
from mcap_ros2.reader import read_ros2_messages
from push_bag.replay.recompute import Changes, recomputed
from push_bag.run.run_reader import read_run
from push_sim.settings import profile
from rosbags.highlevel import AnyReader

LINE = ('--track', 'line', '--speed', '0.15')


@pytest.fixture(scope='module')
def realtime_run(
    environment: dict[str, str], tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Ended]:
    """One straight line in real time."""
    runs = tmp_path_factory.mktemp('line') / 'runs'
    yield Ended.of(environment, *LINE, *PATIENT, '-o', str(runs))


def score_of(run: Ended) -> dict[str, Any]:
    score: dict[str, Any] = json.loads((run.folder / 'score.json').read_text())
    return score


def lost_messages(run: Ended) -> int:
    return sum(count['lost'] for count in score_of(run)['messages'].values())


def assert_truth_pairs_with_poses(run: Ended) -> None:
    recorded = read_run(run.folder)
    truth, measured = recorded.truth, recorded.object
    np.testing.assert_array_equal(truth.stamp, measured.stamp)
    noise = (measured.values - truth.values)[:, :2]
    stated = profile('irb120').sensor.position_noise
    assert np.std(noise) == pytest.approx(stated, rel=0.2)
    assert np.max(np.abs(noise)) < 6.0 * stated


def test_a_run_in_lockstep_is_completed_recorded_whole_and_tracks(
    run_cell: Callable[..., Ended],
) -> None:
    run = run_cell(*LINE, '--mode', 'lockstep')
    assert run.status == 0, run.err
    score = score_of(run)
    assert score['completed']
    assert score['profile'] == 'irb120'
    assert score['model']['points'] == 200
    assert score['tracking_error_mm']['mean'] < 1.6
    assert lost_messages(run) == 0
    assert_truth_pairs_with_poses(run)
    assert (run.folder / 'report.html').stat().st_size < 6e6


def test_a_run_in_real_time_is_completed_or_says_why_not(realtime_run: Ended) -> None:
    score = score_of(realtime_run)
    assert (score['mode'], score['bag_finished']) == ('realtime', True)
    assert realtime_run.status == (0 if score['completed'] else 1)
    said = 'cell: the run was not completed: ' in realtime_run.err
    assert said != score['completed']
    assert (realtime_run.folder / 'report.html').exists()


def test_two_other_readers_find_the_same_topics_counts_and_poses(realtime_run: Ended) -> None:
    ours = read_run(realtime_run.folder)
    expected = Counter({topic: seen.received for topic, seen in ours.traffic.items()})
    (bag,) = realtime_run.folder.glob('*.mcap')
    with AnyReader([realtime_run.folder]) as reader:
        theirs = [
            (connection.topic, reader.deserialize(data, connection.msgtype))
            for connection, _, data in reader.messages()
        ]
    assert Counter(topic for topic, _ in theirs) == expected
    others = [(seen.channel.topic, seen.ros_msg) for seen in read_ros2_messages(bag)]
    assert Counter(topic for topic, _ in others) == expected
    for messages in (theirs, others):
        poses = [message.pose for topic, message in messages if topic == '/object_pose']
        positions = np.array([[pose.position.x, pose.position.y] for pose in poses])
        np.testing.assert_array_equal(
            positions[-len(ours.object.values) :], ours.object.values[:, :2]
        )


def test_score_and_info_read_the_run(realtime_run: Ended, environment: dict[str, str]) -> None:
    scored = Ended.of_command(
        environment, 'ros2', 'run', 'push_bag', 'score', str(realtime_run.folder), '--json'
    )
    assert json.loads(scored.out) == json.loads((realtime_run.folder / 'score.json').read_text())
    told = Ended.of_command(
        environment, 'ros2', 'run', 'push_bag', 'info', str(realtime_run.folder)
    )
    assert told.status == 0
    assert '/controller_state' in told.out


def test_the_commands_computed_again_are_the_recorded_ones(realtime_run: Ended) -> None:
    again = recomputed(realtime_run.folder, Changes())
    assert again.stamp.size > 0
    if not lost_messages(realtime_run):
        assert again.same
        return
    # without a pose or a tick in the bag, later commands may differ
    proven = again.stamp < first_gap(realtime_run.folder)
    if not proven.any():
        pytest.skip('the recorder lost a message of the first tick')
    assert not again.differs[proven].any()


def first_gap(folder: Path) -> float:
    """Stamp [ns] before the first message that the bag lacks of a topic with one each 10 ms."""
    run = read_run(folder)
    gaps = [
        topic.stamp[:-1][np.diff(topic.stamp) > 15_000_000]
        for topic in (run.object, run.pusher, run.commands, run.states)
    ]
    return float(min((gap[0] for gap in gaps if gap.size), default=np.inf))


def test_two_cells_run_side_by_side_in_namespaces(
    environment: dict[str, str], tmp_path: Path
) -> None:
    from concurrent.futures import ThreadPoolExecutor  # noqa: PLC0415

    def run(namespace: str) -> Ended:
        return Ended.of(
            environment,
            *('--track', 'line', '--speed', '0.2', '--mode', 'lockstep'),
            *('--namespace', namespace, '-o', str(tmp_path / namespace)),
        )

    with ThreadPoolExecutor() as pool:
        left, right = pool.map(run, ('left', 'right'))
    assert (left.status, right.status) == (0, 0), left.err + right.err


def test_a_second_cell_of_the_same_name_is_refused(
    pushing_cell: object, run_cell: Callable[..., Ended]
) -> None:
    second = run_cell('--track', 'line')
    assert second.status == 1
    assert '--namespace' in second.err.splitlines()[-1]
