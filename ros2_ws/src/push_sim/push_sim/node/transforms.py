"""The frames of object and tip in the world, for `/tf`: one message that is filled in place."""

from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped
from push_core.geometry import Array, yaw_to_quaternion
from tf2_msgs.msg import TFMessage

from push_sim.node.conversions import FRAME


class Transforms:
    """Makes the message of `/tf`."""

    def __init__(self, namespace: str) -> None:
        """Names the frames `slider` and `pusher`, so in a namespace that two cells stay apart.

        Args:
            namespace: of the node.
        """
        prefix = f'{namespace.strip("/")}/'.lstrip('/')
        self._slider = TransformStamped(child_frame_id=f'{prefix}slider')
        self._pusher = TransformStamped(child_frame_id=f'{prefix}pusher')
        self._slider.header.frame_id = self._pusher.header.frame_id = FRAME
        self._message = TFMessage(transforms=[self._slider, self._pusher])

    def at(self, object_pose: Array, tip_position: Array, stamp: Time) -> TFMessage:
        """Where both are; the next call fills the same message.

        Args:
            object_pose: (3,) x [m], y [m], theta [rad].
            tip_position: (2,) [m].
            stamp: when they were there.
        """
        _place(self._slider, object_pose, stamp)
        _place(self._pusher, tip_position, stamp)
        turn = self._slider.transform.rotation
        turn.x, turn.y, turn.z, turn.w = yaw_to_quaternion(float(object_pose[2]))
        return self._message


def _place(frame: TransformStamped, position: Array, stamp: Time) -> None:
    frame.header.stamp = stamp
    translation = frame.transform.translation
    translation.x, translation.y = float(position[0]), float(position[1])
