"""A bag is published as it was recorded: bytes, order, timing, QoS."""

import time

import pytest
import rclpy
from push_bag.commands.replay import main
from push_bag.file.qos_text import qos_profile, qos_text
from push_bag.file.reader import BagReader, Record
from push_bag.file.topic_registry import Topic
from push_bag.record.raw_subscription import RawSubscription
from push_bag.replay.playback import Publishers, from_time, in_order, play
from push_bag.replay.survey import survey
from push_core.common.errors import InputError
from push_node.interface import TOPICS
from rclpy.qos import HistoryPolicy, QoSProfile

pytestmark = pytest.mark.processes

SECOND = 1_000_000_000  # [ns]
PATIENCE = 60.0  # [s]; nothing but a hang takes that long


class Clock:
    """A clock that advances only by `sleep`."""

    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now

    def sleep(self, seconds):
        self.now += seconds


def record(log_ns):
    return Record(Topic('/a', None), b'', log_ns, log_ns, 1)


@pytest.mark.parametrize('rate', [1.0, 4.0])
def test_records_are_published_at_their_time_after_the_first(perfect, rate):
    clock, sent = Clock(), []
    records = list(in_order(BagReader(perfect).records(), SECOND))
    count = play(records, lambda _: sent.append(clock.now), rate, 1.0, clock, clock.sleep)
    assert count == len(records)
    expected = [100.0 + (each.log_ns - records[0].log_ns) * 1e-9 / rate for each in records]
    assert sent == pytest.approx(expected, abs=1e-6)


def test_records_are_sorted_by_log_time():
    times = [5, 3, 8, 6, 2_000_000_000, 9]
    assert [each.log_ns for each in in_order(map(record, times), 2_000_000_000)] == sorted(times)


def test_offered_profiles_survive_the_bag():
    for topic in TOPICS:
        profile = qos_profile(qos_text(topic.qos))
        for policy in ('reliability', 'durability', 'depth', 'deadline'):
            assert getattr(profile, policy) == getattr(topic.qos, policy)


def test_a_profile_of_unknown_depth_becomes_one_that_can_publish():
    unknown = qos_text(QoSProfile(history=HistoryPolicy.UNKNOWN))
    assert qos_profile(unknown).history == HistoryPolicy.KEEP_LAST
    assert qos_profile('').depth > 0


def test_text_that_is_no_profile_is_refused():
    for text in ('[{history: sometimes}]', '[1]', '{', '[{history: [], depth: -1}]'):
        with pytest.raises(InputError, match='not a list of QoS profiles'):
            qos_profile(text)


@pytest.mark.parametrize(
    ('words', 'reason'),
    [
        (['--rate', '0'], '--rate must be above 0'),
        (['--start', '-1'], '--start must not be below 0'),
        (['--start', 'nan'], '--start must not be below 0'),
        (['--delay', 'inf'], '--delay must not be below 0'),
        (['--topics', 'perturbation'], 'no message of a topic perturbation'),
        (['--start', '60', '--loop'], '--start 60 is after the end at 1.'),
        (['--ask', '--recompute'], 'name one of them'),
        (['--qp', '3', '--recompute'], 'name one of them'),
        (['--qp', '3', '--loop'], '--loop has no effect'),
        (['--ask', '--controller', 'gp'], 'need --recompute'),
        (['--html', 'page.html'], '--html needs --recompute or --ask'),
        (['--recompute', '--rate', '2'], '--rate has no effect'),
        (['--ask', '--loop'], '--loop has no effect'),
    ],
)
def test_an_option_without_effect_or_out_of_range_gives_one_line(perfect, capsys, words, reason):
    assert main([str(perfect), *words]) == 2
    error = capsys.readouterr().err
    assert reason in error
    assert error.count('\n') == 1


def test_a_subscriber_receives_the_recorded_bytes(perfect):
    """Over DDS, with a latched and a reliable topic of the bag."""
    names = {'/nominal_trajectory', '/controller_state'}
    records = list(in_order(BagReader(perfect).records(names), SECOND))
    rclpy.init()
    node = rclpy.create_node('player')
    try:
        topics = {record.topic.name: record.topic for record in records}
        publishers = Publishers(node, topics.values())
        listener = rclpy.create_node('listener')
        ears = {
            name: RawSubscription(listener, name, topic.type_name, qos_profile(topic.qos))
            for name, topic in topics.items()
        }
        publishers.wait_until_matched(PATIENCE)
        play(records, publishers.publish, rate=10.0, seconds=1.0)
        received = {name: [] for name in names}
        end = time.monotonic() + PATIENCE
        while sum(map(len, received.values())) < len(records) and time.monotonic() < end:
            for name, ear in ears.items():
                received[name] += [taken.data for taken in ear.take_all()]
        listener.destroy_node()
    finally:
        node.destroy_node()
        rclpy.shutdown()
    for name in names:
        assert received[name] == [each.data for each in records if each.topic.name == name]


def test_only_the_named_topics_are_found(perfect):
    found = survey(perfect, ['object_pose', '/model_info'])
    assert set(found.topics) == {'/object_pose', '/model_info'}
    with pytest.raises(InputError, match='no message of a topic nonsense'):
        survey(perfect, ['nonsense'])


def test_the_start_counts_from_the_beginning_of_the_bag_whatever_the_topics(perfect):
    whole, late = survey(perfect, None), survey(perfect, ['run_end'])
    assert late.first_ns == whole.first_ns
    assert late.seconds == pytest.approx(whole.seconds, abs=0.01)


def test_latched_messages_before_the_start_are_not_skipped(perfect):
    found = survey(perfect, None)
    begin = found.first_ns + 500_000_000
    records = list(from_time(begin, in_order(BagReader(perfect).records(), SECOND)))
    assert min(each.log_ns for each in records) >= begin
    assert [each.topic.name for each in records[:2]] == ['/nominal_trajectory', '/model_info']
    assert records[2].log_ns < begin + 10_000_000


def test_without_a_controller_asking_is_one_line_and_status_1(perfect, monkeypatch, capfd):
    monkeypatch.setattr('push_node.ask.READY_TIMEOUT', 0.1)
    assert main([str(perfect), '--ask']) == 1
    error = capfd.readouterr().err
    assert error.endswith(': no mpc_node answers push_mpc/stop; see replay --help\n')
    assert error.count('\n') == 1
