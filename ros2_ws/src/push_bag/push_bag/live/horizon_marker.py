"""The planned horizon as a serialized marker, for viewers that show standard messages only."""

from push_msgs.msg import Horizon
from rclpy.serialization import deserialize_message, serialize_message

from push_bag.live.plan_markers import horizon_marker

HORIZON_TYPE = 'push_msgs/msg/Horizon'
MARKER_TYPE = 'visualization_msgs/msg/Marker'


def serialized_marker(data: bytes) -> bytes:
    """A serialized Marker that shows a serialized Horizon as a line above the object."""
    return bytes(serialize_message(horizon_marker(deserialize_message(data, Horizon))))
