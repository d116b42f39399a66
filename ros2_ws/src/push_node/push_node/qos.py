"""QoS profiles of the graph's topics; `interface.py` says which topic has which."""

from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

# a deadline takes effect only if both publisher and subscriber have one
POSE = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.BEST_EFFORT, deadline=Duration(nanoseconds=20_000_000)
)
# for subscribers to poses: matches every publisher, reliable or not, with or without a deadline
POSE_SUBSCRIPTION = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
# for those that need each pose, also those that came while they were busy
POSE_HISTORY = QoSProfile(depth=64, reliability=ReliabilityPolicy.BEST_EFFORT)
COMMAND = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)
LATCHED = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
# a late subscriber gets every message
HISTORY = QoSProfile(
    depth=1000,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
STATE = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)
EVENT = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)
# as tf2_ros has it
TF = QoSProfile(depth=100, reliability=ReliabilityPolicy.RELIABLE)
SCENE = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


def is_latched(profile: QoSProfile) -> bool:
    """Whether a late subscriber still gets what was published before."""
    return bool(profile.durability == DurabilityPolicy.TRANSIENT_LOCAL)
