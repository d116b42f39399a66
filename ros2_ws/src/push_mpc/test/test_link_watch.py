"""Which driver the controller asks for the way to it."""

from collections.abc import Iterator

import pytest
import rclpy
from push_mpc.node.link_watch import LinkWatch
from rclpy.context import Context
from rclpy.node import Node
from rclpy.topic_endpoint_info import TopicEndpointInfo


class Observer(Node):
    """A node to which discovery tells the publishers of this test."""

    publishers_told: tuple[tuple[str, str], ...] = ()

    def get_publishers_info_by_topic(self, topic: str, no_mangle: bool = False) -> list:
        return [
            TopicEndpointInfo(node_namespace=namespace, node_name=name)
            for namespace, name in self.publishers_told
        ]


@pytest.fixture
def observer() -> Iterator[Observer]:
    context = Context()
    rclpy.init(context=context)
    node = Observer('observer', context=context)
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_a_driver_is_asked_once_its_name_is_known(observer: Observer) -> None:
    watch = LinkWatch(observer, 0.005)
    observer.publishers_told = (('_NODE_NAMESPACE_UNKNOWN_', '_NODE_NAME_UNKNOWN_'),)
    watch.poll()
    asked = [client.srv_name for client in observer.clients]
    observer.publishers_told = (('/', 'robot'),)
    watch.poll()
    assert asked == []
    assert '/robot/get_parameters' in [client.srv_name for client in observer.clients]
