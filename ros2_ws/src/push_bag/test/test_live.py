"""The live view, read by an independent WebSocket client."""

import json
import signal
import struct
import subprocess
import sys
import time
from collections.abc import Iterator

import pytest
import rclpy
from geometry_msgs.msg import PoseStamped
from push_msgs.msg import Horizon, ModelInfo
from push_node import qos
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from visualization_msgs.msg import Marker
from websockets.sync.client import ClientConnection, connect

pytestmark = pytest.mark.processes

PATIENCE = 60.0  # [s]; nothing but a hang takes that long
MESSAGE_DATA = 1  # opcode of the protocol's binary frames


class Watcher:
    """A client of the Foxglove WebSocket protocol."""

    def __init__(self, socket: ClientConnection) -> None:
        self._socket = socket
        self.channels: dict[str, dict[str, object]] = {}
        self._topics: dict[int, str] = {}

    def announced(self, topic: str) -> dict[str, object]:
        while topic not in self.channels:
            self._take_announcement(self._socket.recv(timeout=PATIENCE))
        return self.channels[topic]

    def subscribe(self, topic: str) -> None:
        number = len(self._topics) + 1
        self._topics[number] = topic
        wanted = [{'id': number, 'channelId': self.announced(topic)['id']}]
        self._socket.send(json.dumps({'op': 'subscribe', 'subscriptions': wanted}))

    def message(self, patience: float = PATIENCE) -> tuple[str, bytes] | None:
        while True:
            try:
                frame = self._socket.recv(timeout=patience)
            except TimeoutError:
                return None
            if isinstance(frame, bytes) and frame[0] == MESSAGE_DATA:
                number, _time = struct.unpack_from('<IQ', frame, 1)
                return self._topics[number], frame[13:]
            self._take_announcement(frame)

    def _take_announcement(self, frame: str | bytes) -> None:
        if isinstance(frame, str) and (said := json.loads(frame))['op'] == 'advertise':
            self.channels.update({each['topic']: each for each in said['channels']})


@pytest.fixture
def publisher() -> Iterator[Node]:
    rclpy.init()
    yield rclpy.create_node('cell')
    rclpy.try_shutdown()


@pytest.fixture
def port() -> Iterator[int]:
    """The port of a running live view."""
    process = subprocess.Popen(
        [
            sys.executable,
            '-m',
            'push_bag.commands.live',
            '--ros-args',
            '-p',
            'port:=0',
            '-p',
            'page_port:=0',
        ],
        stderr=subprocess.PIPE,
        text=True,
    )
    said = process.stderr.readline()
    yield int(said.split('ws://127.0.0.1:')[1].split()[0])
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=PATIENCE) == 0


def test_a_client_receives_poses_and_earlier_latched_messages(publisher: Node, port) -> None:
    models = publisher.create_publisher(ModelInfo, 'model_info', qos.LATCHED)
    poses = publisher.create_publisher(PoseStamped, 'object_pose', qos.POSE)
    plans = publisher.create_publisher(Horizon, 'horizon', qos.STATE)
    models.publish(ModelInfo(model_id='early', points=7))
    with connect(f'ws://127.0.0.1:{port}', subprotocols=['foxglove.sdk.v1']) as socket:
        watcher = Watcher(socket)
        channel = watcher.announced('/object_pose')
        assert (channel['encoding'], channel['schemaEncoding']) == ('cdr', 'ros2msg')
        assert 'MSG: geometry_msgs/Quaternion' in channel['schema']
        time.sleep(0.5)
        watcher.subscribe('/model_info')
        topic, data = watcher.message()
        assert topic == '/model_info'
        assert deserialize_message(data, ModelInfo).model_id == 'early'

        watcher.subscribe('/object_pose')
        moved = PoseStamped()
        moved.pose.position.x = 0.125
        topic = ''
        while topic != '/object_pose':
            # poses are best effort: the first ones may get lost
            poses.publish(moved)
            topic, data = watcher.message(patience=0.2) or ('', b'')
        assert deserialize_message(data, PoseStamped).pose.position.x == 0.125

        # the horizon comes as a line that every viewer can draw
        watcher.subscribe('/horizon_line')
        planned, line = Horizon(x=[0.1, 0.2, 0.3], y=[0.0, 0.5, 1.0]), b''
        planned.header.frame_id = 'world'
        while topic != '/horizon_line':
            plans.publish(planned)
            topic, line = watcher.message(patience=0.2) or ('', b'')
        marker = deserialize_message(line, Marker)
        assert (marker.type, marker.header.frame_id) == (Marker.LINE_STRIP, 'world')
        assert [(point.x, point.y) for point in marker.points] == [
            (0.1, 0.0),
            (0.2, 0.5),
            (0.3, 1.0),
        ]
