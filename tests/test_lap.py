"""A recorded and scored run, in real time, as readers that we did not write see it."""

import json
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from cell_command import Ended
from mcap_ros2.reader import read_ros2_messages
from push_bag.run_reader import read_run
from rosbags.highlevel import AnyReader


@pytest.fixture(scope='module')
def realtime_run(
    environment: dict[str, str], tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Ended]:
    """One straight line in real time."""
    yield Ended.of(
        environment, '--track', 'line', '-o', str(tmp_path_factory.mktemp('line') / 'runs')
    )


def test_a_realtime_run_is_completed_recorded_whole_and_scored(realtime_run: Ended) -> None:
    assert realtime_run.status == 0, realtime_run.err
    score = json.loads((realtime_run.folder / 'score.json').read_text())
    assert score['completed']
    assert score['profile'] == 'irb120'
    assert score['model']['points'] == 200
    assert score['tracking_error_mm']['mean'] < 4.0
    assert {topic: count['lost'] for topic, count in score['messages'].items()} == dict.fromkeys(
        score['messages'], 0
    )
    assert (realtime_run.folder / 'report.html').stat().st_size < 6e6


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


def test_the_commands_computed_again_are_the_recorded_ones(
    realtime_run: Ended, environment: dict[str, str]
) -> None:
    replay = ('ros2', 'run', 'push_bag', 'replay', str(realtime_run.folder), '--recompute')
    told = Ended.of_command(environment, *replay)
    assert told.status == 0, told.out + told.err
    assert 'commands are the same, bit for bit' in told.out


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
