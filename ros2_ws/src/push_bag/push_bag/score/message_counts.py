"""Received and lost messages of each topic.

lost             gaps in the sequence numbers; without numbers, gaps in the grid of stamps,
missing_stamps   gaps in the grid of stamps; includes messages that were never published,
middleware_lost  messages that the middleware reported as lost.
"""

import numpy as np
from push_node import interface
from push_node.endpoints import short_name

from push_bag.file import Traffic
from push_bag.run import Nanoseconds, RunSeries

POSE_PERIOD_NS = 10_000_000


def message_counts(run: RunSeries) -> dict[str, dict[str, int | None]]:
    """Counts by topic; None where unknown."""
    stamps = {
        interface.OBJECT_POSE.short_name: run.object.stamp,
        interface.PUSHER_POSE.short_name: run.pusher.stamp,
        interface.PUSHER_VELOCITY_CMD.short_name: run.commands.stamp,
        interface.CONTROLLER_STATE.short_name: run.states.stamp,
    }
    return {
        topic: _counts(seen, missing_stamps(stamps.get(short_name(topic))))
        for topic, seen in sorted(run.traffic.items())
    }


def foreign_commands(run: RunSeries) -> int:
    """Number of commands that another publisher sent: they answer no tick of the controller.

    Ticks that were lost on their way to the recorder do not count against their commands; where no
    tick was recorded, nothing tells.
    """
    if not run.foreign_commands or not run.states.stamp.size:
        return 0
    states = interface.CONTROLLER_STATE.short_name
    counts = message_counts(run)
    lost = sum(each['lost'] or 0 for name, each in counts.items() if short_name(name) == states)
    return max(0, run.foreign_commands - lost)


def missing_stamps(stamps: Nanoseconds | None) -> int | None:
    """Messages missing from a topic that has one each POSE_PERIOD_NS, by its stamps (n,) [ns]."""
    if stamps is None:
        return None
    steps = np.rint(np.diff(stamps) / POSE_PERIOD_NS).astype(np.int64)
    return int(np.sum(np.maximum(steps - 1, 0)))


def _counts(seen: Traffic, missing: int | None) -> dict[str, int | None]:
    return {
        'received': seen.received,
        'lost': seen.lost if seen.lost_is_known else missing,
        'missing_stamps': missing,
        'middleware_lost': seen.middleware_lost,
    }
