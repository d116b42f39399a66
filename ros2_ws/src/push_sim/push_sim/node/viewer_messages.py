"""What a viewer needs beside the poses: markers of slider and tip, and their `/tf` frames."""

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, TransformStamped
from push_core.geometry import Array, yaw_to_quaternion
from push_core.physics import Slider
from std_msgs.msg import ColorRGBA
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from push_sim.node.conversions import FRAME, pose_message, position_message

_SLIDER_HEIGHT = 0.013
_TIP_HEIGHT = 0.05
_STEEL = ColorRGBA(r=0.55, g=0.6, b=0.65, a=1.0)
_ORANGE = ColorRGBA(r=0.9, g=0.45, b=0.1, a=1.0)


def scene_markers(
    slider: Slider, object_pose: Array, tip_position: Array, stamp: Time
) -> MarkerArray:
    """The slider as a box and the tip as a cylinder.

    Args:
        slider: dimensions of both.
        object_pose: (3,) x [m], y [m], theta [rad].
        tip_position: (2,) [m].
        stamp: time of these poses.
    """
    box = Marker(ns='slider', type=Marker.CUBE, color=_STEEL)
    _place_marker(box, pose_message(object_pose, stamp), _SLIDER_HEIGHT)
    box.scale.x, box.scale.y, box.scale.z = slider.side, slider.side, _SLIDER_HEIGHT
    rod = Marker(ns='tip', type=Marker.CYLINDER, color=_ORANGE)
    _place_marker(rod, position_message(tip_position, stamp), _TIP_HEIGHT)
    rod.scale.x, rod.scale.y, rod.scale.z = (*[2.0 * slider.tip_radius] * 2, _TIP_HEIGHT)
    return MarkerArray(markers=[box, rod])


class Transforms:
    """The `/tf` message with the frames of object and tip, allocated once and reused."""

    def __init__(self, namespace: str) -> None:
        """Names the frames `slider` and `pusher`, with the namespace as prefix.

        Args:
            namespace: namespace of the node; keeps the frames of two cells apart.
        """
        prefix = f'{namespace.strip("/")}/'.lstrip('/')
        self._slider = TransformStamped(child_frame_id=f'{prefix}slider')
        self._pusher = TransformStamped(child_frame_id=f'{prefix}pusher')
        self._slider.header.frame_id = self._pusher.header.frame_id = FRAME
        self._message = TFMessage(transforms=[self._slider, self._pusher])

    def at(self, object_pose: Array, tip_position: Array, stamp: Time) -> TFMessage:
        """The message for these poses; the next call overwrites it.

        Args:
            object_pose: (3,) x [m], y [m], theta [rad].
            tip_position: (2,) [m].
            stamp: time of these poses.
        """
        _place_frame(self._slider, object_pose, stamp)
        _place_frame(self._pusher, tip_position, stamp)
        turn = self._slider.transform.rotation
        turn.x, turn.y, turn.z, turn.w = yaw_to_quaternion(float(object_pose[2]))
        return self._message


def _place_marker(marker: Marker, at: PoseStamped, height: float) -> None:
    marker.header, marker.pose = at.header, at.pose
    marker.pose.position.z = height / 2.0


def _place_frame(frame: TransformStamped, position: Array, stamp: Time) -> None:
    frame.header.stamp = stamp
    translation = frame.transform.translation
    translation.x, translation.y = float(position[0]), float(position[1])
