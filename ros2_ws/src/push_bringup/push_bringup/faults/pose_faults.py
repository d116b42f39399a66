"""Poses that are lost, or cannot be."""

import math
import random

from geometry_msgs.msg import Pose, PoseStamped
from push_mpc.settings import MpcSettings
from push_node import interface
from push_node.endpoints import GraphTopic
from push_node.stamps import to_nanoseconds, to_stamp

from push_bringup.faults.bed import Bed
from push_bringup.faults.case import Fault, Outcome
from push_bringup.faults.injections import FOR_GOOD, Inject, wait_out
from push_bringup.faults.relay import Spoil

POSE_TIMEOUT = MpcSettings().pose_timeout
FROZEN = 0.27  # [s], parameter guard.frozen and one tick
FAST = 0.04  # [s] longer to rest from the largest speed: docs/operating.md, and one tick
OVERLAPS = 0.35  # [s] until the tip seems to be guard.overlap inside the object


def _spoil(spoil: Spoil, duration: float) -> Inject:
    def inject(bed: Bed, _random: random.Random) -> float:
        bed.relay.spoil = spoil
        wait_out(bed, duration)
        bed.relay.spoil = None
        return duration

    return inject


def _lost(_message: PoseStamped, _topic: str) -> bool:
    return False


def _not_a_number(message: PoseStamped, _topic: str) -> bool:
    message.pose.position.x = math.nan
    return True


def _wrong_frame(message: PoseStamped, _topic: str) -> bool:
    message.header.frame_id = 'camera'
    return True


def _no_rotation(message: PoseStamped, _topic: str) -> bool:
    message.pose.orientation.w = 0.0
    return True


def _tilted(message: PoseStamped, topic: str) -> bool:
    if topic == interface.OBJECT_POSE.short_name:
        message.pose.orientation.x = math.sin(0.25)
        message.pose.orientation.w *= math.cos(0.25)
        message.pose.orientation.z *= math.cos(0.25)
    return True


def _shifted(seconds: float) -> Spoil:
    def spoil(message: PoseStamped, _topic: str) -> bool:
        stamp = to_nanoseconds(message.header.stamp) + round(1e9 * seconds)
        message.header.stamp = to_stamp(max(stamp, 0))
        return True

    return spoil


def _jumping(message: PoseStamped, topic: str) -> bool:
    """One pose of the object in nine is 0.3 m away."""
    if topic == interface.OBJECT_POSE.short_name and message.header.stamp.nanosec % 9 == 0:
        message.pose.position.y += 0.3
    return True


def _frozen(*topics: GraphTopic) -> Inject:
    """The poses of topics repeat, with new stamps."""

    def inject(bed: Bed, chance: random.Random) -> float:
        first: dict[str, Pose] = {}

        def repeat(message: PoseStamped, topic: str) -> bool:
            if topic in names:
                message.pose = first.setdefault(topic, message.pose)
            return True

        return _spoil(repeat, FOR_GOOD)(bed, chance)

    names = {topic.short_name for topic in topics}
    return inject


def _stops(spoil: Spoil, text: str, reason: str) -> Fault:
    return Fault(text, Outcome.STOPS, _spoil(spoil, FOR_GOOD), reason, POSE_TIMEOUT)


_DROPOUTS = {
    f'dropout_{round(1e3 * duration)}ms': Fault(
        f'no pose for {round(1e3 * duration)} ms', Outcome.CONTINUES, _spoil(_lost, duration)
    )
    for duration in (0.02, 0.05, 0.2)
}
_REPEATED = {
    'pose_frozen': Fault(
        'the cameras repeat one picture',
        Outcome.STOPS,
        _frozen(interface.OBJECT_POSE, interface.PUSHER_POSE),
        'have not changed',
        FROZEN + FAST,
    ),
    'pose_frozen_object': Fault(
        'one camera repeats the pose of the object',
        Outcome.STOPS,
        _frozen(interface.OBJECT_POSE),
        # inside it, or behind it where the tip went round its edge meanwhile
        'the object',
        FROZEN + OVERLAPS + FAST,
    ),
}
POSE_FAULTS: dict[str, Fault] = {
    **_DROPOUTS,
    **_REPEATED,
    'pose_jumping': Fault(
        'one pose of the object in nine is 0.3 m away', Outcome.CONTINUES, _spoil(_jumping, 2.0)
    ),
    'dropout_2s': _stops(_lost, 'no pose for 2 s', 'no pose for'),
    'pose_nan': _stops(_not_a_number, 'x is NaN', 'not finite'),
    'pose_frame': _stops(_wrong_frame, 'the frame of the poses changes', "frame is 'camera'"),
    'pose_quaternion': _stops(_no_rotation, 'the quaternion is no rotation', 'quaternion'),
    'pose_tilted': _stops(_tilted, 'the object is tilted', 'tilted'),
    'clock_back_1s': _stops(_shifted(-1.0), 'the clock of the cameras steps back 1 s', 'old'),
    'clock_ahead_1s': _stops(_shifted(1.0), 'the clock of the cameras steps ahead 1 s', 'future'),
}
