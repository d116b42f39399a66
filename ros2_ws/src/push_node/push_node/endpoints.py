"""Descriptions of topics and services, from which nodes make publishers, servers and so on."""

import importlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy.client import Client
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rclpy.service import Service
from rclpy.subscription import Subscription


@dataclass(frozen=True)
class GraphTopic:
    """One topic of the graph.

    Attributes:
        name: relative to the namespace of the graph, or absolute.
        type_name: in three parts, `geometry_msgs/msg/PoseStamped`.
        qos: offered by its publishers, and asked for by subscribers unless they say otherwise.
        rate: how often it is published, for a person.
        publishers: names of the nodes that publish it.
        description: one line.
        core: whether a recording without it is incomplete.
    """

    name: str
    type_name: str
    qos: QoSProfile
    rate: str
    publishers: tuple[str, ...]
    description: str
    core: bool = False

    @property
    def short_name(self) -> str:
        """The last part of the name."""
        return short_name(self.name)

    @property
    def absolute_name(self) -> str:
        """The name in the root namespace."""
        return f'/{self.name.lstrip("/")}'

    @property
    def message_class(self) -> Any:
        """The Python class of the message; its package is imported here."""
        return _interface_class(self.type_name)

    def publisher(self, node: Node, prefix: str = '', qos: QoSProfile | None = None) -> Publisher:
        """A publisher of this topic.

        Args:
            node: that publishes.
            prefix: comes before the name.
            qos: offered instead of the topic's own.
        """
        return node.create_publisher(self.message_class, f'{prefix}{self.name}', qos or self.qos)

    def subscription(
        self,
        node: Node,
        callback: Callable[[Any], None],
        prefix: str = '',
        qos: QoSProfile | None = None,
    ) -> Subscription:
        """A subscription to this topic.

        Args:
            node: that subscribes.
            callback: called with each message.
            prefix: comes before the name.
            qos: asked for instead of the publisher's.
        """
        return node.create_subscription(
            self.message_class, f'{prefix}{self.name}', callback, qos or self.qos
        )


@dataclass(frozen=True)
class GraphService:
    """One service of the graph.

    Attributes:
        name: relative to the namespace of the graph.
        type_name: in three parts, `std_srvs/srv/Trigger`.
        server: name of the node that offers it.
        description: one line.
    """

    name: str
    type_name: str
    server: str
    description: str

    @property
    def service_class(self) -> Any:
        """The Python class of the service; its package is imported here."""
        return _interface_class(self.type_name)

    def service(self, node: Node, callback: Callable[[Any, Any], Any]) -> Service:
        """The server: `callback` fills the response to a request and returns it."""
        return node.create_service(self.service_class, self.name, callback)

    def client(self, node: Node, prefix: str = '') -> Client:
        """A client of this service; `prefix` comes before the name."""
        return node.create_client(self.service_class, f'{prefix}{self.name}')


def parameter_clients(node: Node, of: str) -> tuple[Client, Client]:
    """Clients that list and get the parameters of the node with a fully qualified name."""
    listing = node.create_client(ListParameters, f'{of}/list_parameters')
    return listing, node.create_client(GetParameters, f'{of}/get_parameters')


def short_name(topic: str) -> str:
    """The last part of a topic's name, which is the same in every namespace."""
    return topic.rpartition('/')[2]


def _interface_class(type_name: str) -> Any:
    package, folder, name = type_name.split('/')
    return getattr(importlib.import_module(f'{package}.{folder}'), name)
