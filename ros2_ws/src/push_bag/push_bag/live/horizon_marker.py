"""The planned horizon as a marker, for viewers that show standard messages only."""

from geometry_msgs.msg import Point
from push_msgs.msg import Horizon
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

HORIZON_TYPE = 'push_msgs/msg/Horizon'
MARKER_TYPE = 'visualization_msgs/msg/Marker'
ABOVE = 0.014  # [m]; the square is 13 mm high
WIDTH = 0.004  # [m]
AMBER = ColorRGBA(r=0.9, g=0.62, b=0.0, a=1.0)


def horizon_marker(data: bytes) -> bytes:
    """A serialized Marker that shows a serialized Horizon as a line above the object."""
    horizon = deserialize_message(data, Horizon)
    line = Marker(header=horizon.header, ns='horizon', type=Marker.LINE_STRIP, color=AMBER)
    line.scale.x = WIDTH
    # replaced by the next horizon; disappears if there is none
    line.lifetime.nanosec = 200_000_000
    places = zip(horizon.x, horizon.y, strict=True)
    line.points = [Point(x=x, y=y, z=ABOVE) for x, y in places]
    return bytes(serialize_message(line))
