"""The topics of the cell: name, type, quality of service."""

from dataclasses import dataclass

from rclpy.qos import QoSProfile

from push_node.qos import COMMAND, EVENT, HISTORY, LATCHED, POSE, SCENE, STATE, TF


@dataclass(frozen=True)
class CellTopic:
    """One topic of the cell.

    Attributes:
        name: relative to the cell's namespace, or absolute.
        type_name: in three parts.
        qos: what its publishers offer.
        core: whether a run is no record without it.
    """

    name: str
    type_name: str
    qos: QoSProfile
    core: bool = False


CELL_TOPICS = (
    CellTopic('object_pose', 'geometry_msgs/msg/PoseStamped', POSE, core=True),
    CellTopic('pusher_pose', 'geometry_msgs/msg/PoseStamped', POSE, core=True),
    CellTopic('pusher_velocity_cmd', 'geometry_msgs/msg/TwistStamped', COMMAND, core=True),
    CellTopic('nominal_trajectory', 'push_msgs/msg/NominalTrajectory', LATCHED, core=True),
    CellTopic('controller_state', 'push_msgs/msg/ControllerState', STATE, core=True),
    CellTopic('model_info', 'push_msgs/msg/ModelInfo', LATCHED, core=True),
    CellTopic('added_pushes', 'push_msgs/msg/AddedPushes', HISTORY),
    CellTopic('horizon', 'push_msgs/msg/Horizon', STATE),
    CellTopic('perturbation', 'push_msgs/msg/Perturbation', EVENT),
    CellTopic('run_end', 'std_msgs/msg/String', LATCHED),
    CellTopic('scene', 'visualization_msgs/msg/MarkerArray', SCENE),
    CellTopic('/diagnostics', 'diagnostic_msgs/msg/DiagnosticArray', QoSProfile(depth=10)),
    CellTopic('/tf', 'tf2_msgs/msg/TFMessage', TF),
    CellTopic('/clock', 'rosgraph_msgs/msg/Clock', QoSProfile(depth=10)),
)


def short_name(topic: str) -> str:
    """The last part of a topic's name: what it is called whatever the namespace."""
    return topic.rpartition('/')[2]
