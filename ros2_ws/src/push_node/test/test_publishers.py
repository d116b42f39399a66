"""Publishers that nothing is lost of, with a subscriber that does not run for a while."""

import time

from push_node.interface import OBJECT_POSE
from push_node.publishers import CONFIRM_TIMEOUT, LosslessPublishers
from push_node.qos import POSE
from rclpy.node import Node
from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy

PATIENT = QoSProfile(history=HistoryPolicy.KEEP_ALL, reliability=ReliabilityPolicy.RELIABLE)
COUNT = 400


def test_every_message_reaches_a_subscriber_that_was_not_there_to_read(
    made_node, spun_until
) -> None:
    node, came = made_node(), []
    outputs = LosslessPublishers(node)
    publisher = outputs.of(OBJECT_POSE)
    OBJECT_POSE.subscription(node, lambda m: came.append(m.header.stamp.sec), qos=PATIENT)
    spun_until(node, lambda: publisher.get_subscription_count() > 0)
    for number in range(COUNT):
        publisher.publish(pose(number))
        outputs.step()
    spun_until(node, lambda: len(came) >= COUNT)
    assert came == list(range(COUNT))


def test_the_controller_hears_them_as_best_effort(made_node, spun_until) -> None:
    node, came = made_node(), []
    publisher = LosslessPublishers(node).of(OBJECT_POSE)
    OBJECT_POSE.subscription(node, came.append, qos=POSE)
    node.create_timer(0.01, lambda: publisher.publish(pose(1)))
    spun_until(node, lambda: bool(came))


def test_nobody_waits_without_a_subscriber(made_node) -> None:
    node: Node = made_node()
    outputs = LosslessPublishers(node)
    outputs.of(OBJECT_POSE).publish(pose(1))
    started = time.monotonic()
    outputs.flush()
    assert time.monotonic() - started < CONFIRM_TIMEOUT


def pose(number: int):
    message = OBJECT_POSE.message_class()
    message.header.stamp.sec = number
    return message
