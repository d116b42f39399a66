"""Markers that show the slider and the tip in a viewer."""

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped
from push_core.geometry import Array
from push_core.physics import Slider
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from push_sim.node.conversions import pose_message, position_message

_SLIDER_HEIGHT = 0.013
_TIP_HEIGHT = 0.05
_STEEL = ColorRGBA(r=0.55, g=0.6, b=0.65, a=1.0)
_ORANGE = ColorRGBA(r=0.9, g=0.45, b=0.1, a=1.0)


def scene(slider: Slider, object_pose: Array, tip_position: Array, stamp: Time) -> MarkerArray:
    """The slider as a box and the tip as a rod.

    Args:
        slider: what they look like.
        object_pose: (3,) x [m], y [m], theta [rad].
        tip_position: (2,) [m].
        stamp: when it looked like this.
    """
    box = Marker(ns='slider', type=Marker.CUBE, color=_STEEL)
    _place(box, pose_message(object_pose, stamp), _SLIDER_HEIGHT)
    box.scale.x, box.scale.y, box.scale.z = slider.side, slider.side, _SLIDER_HEIGHT
    rod = Marker(ns='tip', type=Marker.CYLINDER, color=_ORANGE)
    _place(rod, position_message(tip_position, stamp), _TIP_HEIGHT)
    rod.scale.x, rod.scale.y, rod.scale.z = (*[2.0 * slider.tip_radius] * 2, _TIP_HEIGHT)
    return MarkerArray(markers=[box, rod])


def _place(marker: Marker, at: PoseStamped, height: float) -> None:
    marker.header, marker.pose = at.header, at.pose
    marker.pose.position.z = height / 2.0
