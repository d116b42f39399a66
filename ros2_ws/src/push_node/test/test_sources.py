"""Who publishes poses and commands, as discovery tells it."""

from push_node.graph import UNNAMED, second_source
from rclpy.topic_endpoint_info import TopicEndpointInfo


class Graph:
    """Stands for a node that knows these publishers of each topic; None: no name has come."""

    def __init__(self, *names: str | None) -> None:
        self._names = names

    def get_publishers_info_by_topic(self, topic: str) -> list[TopicEndpointInfo]:
        return [self._endpoint(name) for name in self._names]

    def _endpoint(self, name: str | None) -> TopicEndpointInfo:
        # as rmw_dds_common has it
        unknown = ('_NODE_NAMESPACE_UNKNOWN_', '_NODE_NAME_UNKNOWN_')
        namespace, name = ('/', name) if name else unknown
        return TopicEndpointInfo(node_name=name, node_namespace=namespace)


def test_one_source_is_no_conflict_with_or_without_a_name() -> None:
    assert second_source(Graph('camera')) == second_source(Graph(None)) == ''


def test_a_second_source_is_named() -> None:
    words = 'object_pose has 2 publishers: /camera, /cell'
    assert second_source(Graph('cell', 'camera')) == words


def test_a_second_source_whose_name_has_not_come_is_said_to_be_one() -> None:
    words = f'object_pose has 2 publishers: /cell, {UNNAMED}'
    assert second_source(Graph(None, 'cell')) == words
