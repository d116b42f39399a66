import pytest
from push_node import qos
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Int32


def test_whoever_comes_late_still_gets_what_is_latched(made_node, spun_until) -> None:
    node, seen = made_node(), []
    publisher = node.create_publisher(Int32, 'latched', qos.LATCHED)
    for number in (1, 2):
        publisher.publish(Int32(data=number))
    node.create_subscription(Int32, 'latched', lambda m: seen.append(m.data), qos.LATCHED)
    spun_until(node, lambda: bool(seen))
    assert seen == [2]


@pytest.mark.parametrize('name', ['POSE', 'COMMAND', 'LATCHED', 'STATE', 'EVENT', 'SCENE'])
def test_every_profile_connects_a_publisher_to_its_subscriber(made_node, spun_until, name) -> None:
    node, seen, profile = made_node(), [], getattr(qos, name)
    publisher = node.create_publisher(Int32, name.lower(), profile)
    node.create_subscription(Int32, name.lower(), seen.append, profile)
    node.create_timer(0.01, lambda: publisher.publish(Int32(data=1)))
    spun_until(node, lambda: bool(seen))


def test_a_pose_without_a_deadline_does_not_reach_the_controller(made_node, spun_until) -> None:
    node = made_node()
    without = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
    publisher = node.create_publisher(Int32, 'undated', without)
    node.create_subscription(Int32, 'undated', lambda _message: None, qos.POSE)
    node.create_subscription(Int32, 'undated', lambda _message: None, without)
    spun_until(node, lambda: publisher.get_subscription_count() > 0)
    assert publisher.get_subscription_count() == 1
