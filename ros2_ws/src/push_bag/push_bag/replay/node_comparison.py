"""Compares the recorded commands of a run with those of a running mpc_node.

`--recompute` calls the controller in process. This one also checks the node: its topics, services,
QoS and lockstep clock.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
from push_core.common import InputError
from push_msgs.msg import ControllerState
from push_node.endpoints import short_name
from push_node.interface import OBJECT_POSE, PUSHER_POSE
from rclpy.node import Node
from tqdm import tqdm

from push_bag.replay.node_client import NodeClient, TickInput
from push_bag.replay.recompute import Recomputed
from push_bag.run import PAIRED, ByStamp, Floats, RecordedRun, RecordedTick, nanoseconds

POSES = (OBJECT_POSE.short_name, PUSHER_POSE.short_name)


def compared_with_node(path: Path, node: Node) -> Recomputed:
    """Sends the recorded poses of a run to a running mpc_node and collects its commands.

    Args:
        path: run folder or MCAP file.
        node: publishes the poses.

    Raises:
        InputError: there is no readable bag, or no tick or no pose in it.
        RunError: no controller answers.
    """
    return NodeComparison(RecordedRun(path), node).result()


class NodeComparison:
    """Gives a controller node the inputs of each tick of a run."""

    def __init__(self, run: RecordedRun, node: Node) -> None:
        """Reads the poses.

        Raises:
            InputError: there are none.
        """
        self._run = run
        self._messages: dict[str, list[Any]] = {name: [] for name in POSES}
        published: dict[str, list[int]] = {name: [] for name in POSES}
        topic = ''
        for record in run.reader.records():
            name = short_name(record.topic.name)
            if name in self._messages:
                topic = record.topic.name
                self._messages[name].append(record.message())
                published[name].append(record.publish_ns)
        if not topic:
            raise InputError(f'{run.reader.path} holds no poses')
        self._by_stamp = {
            name: ByStamp([nanoseconds(message) for message in messages], published[name])
            for name, messages in self._messages.items()
        }
        self._client = NodeClient(node, topic[: -len(short_name(topic))])
        self._mode = ControllerState.IDLE

    def result(self) -> Recomputed:
        """Runs all ticks."""
        rows: list[tuple[int, Floats, Floats]] = []
        skipped = 0
        ticks = tqdm(self._run.ticks(), total=len(self._run), unit='tick', disable=None)
        for tick in ticks:
            command = self._command(tick)
            if tick.velocity is None or tick.mode == ControllerState.IDLE:
                continue
            if command is None:
                skipped += 1
            else:
                rows.append((tick.stamp, tick.velocity, command))
        return Recomputed(
            np.array([stamp for stamp, _, _ in rows], np.int64),
            np.array([recorded for _, recorded, _ in rows], np.float64).reshape(-1, 2),
            np.array([command for _, _, command in rows], np.float64).reshape(-1, 2),
            skipped,
        )

    def _command(self, tick: RecordedTick) -> Floats | None:
        """The node's command at a tick; None if the bag lacks its poses."""
        inputs = self._inputs(tick)
        before, self._mode = self._mode, tick.mode
        if tick.stop_reason and inputs is None:
            return self._client.stop()
        if tick.mode == ControllerState.IDLE or inputs is None:
            return None
        if tick.mode == ControllerState.ARMED and before != ControllerState.ARMED:
            self._client.start(inputs)
        return self._client.command(inputs)

    def _inputs(self, tick: RecordedTick) -> TickInput | None:
        """Inputs of a tick; None for a tick without poses, or if the bag lacks them."""
        object_pose, tip = (self._message(name, tick) for name in POSES)
        if math.isnan(tick.exposure) or object_pose is None or tip is None:
            return None
        # in lockstep, as which the node runs, the stamps of a pair are equal
        tip.header.stamp = object_pose.header.stamp
        now = tick.stamp + round((tick.now - tick.exposure) * 1e9)
        return TickInput(tick.stamp, now, object_pose, tip)

    def _message(self, name: str, tick: RecordedTick) -> Any:
        within = PAIRED if name == PUSHER_POSE.short_name else 0
        row = self._by_stamp[name].row(tick.stamp, tick.published, within)
        return None if row is None else self._messages[name][row]
