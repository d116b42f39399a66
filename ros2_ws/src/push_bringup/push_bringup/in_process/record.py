"""Records a run in one process: the same topics as the node graph, in plant time."""

from collections.abc import Sequence
from typing import Any

from geometry_msgs.msg import TwistStamped
from push_bag.file import BagWriter, qos_text
from push_gp.models import ModelInfo
from push_gp.server.conversions import model_info_message
from push_mpc.loop import Controller, Mode, Tick
from push_mpc.node import conversions as mpc
from push_mpc.node.horizon_message import HORIZON_EVERY, HorizonMessage
from push_mpc.settings import MpcSettings
from push_msgs.msg import ControllerState, Lesson
from push_node import interface
from push_node.endpoints import GraphTopic
from push_node.stamps import to_stamp
from push_sim.node import conversions as sim
from push_sim.plant import Observation, Plant
from rclpy.serialization import serialize_message

from push_bringup.in_process.loop import nanoseconds

ALSO_RECORDED = (
    *(interface.PERTURBATION, interface.HORIZON, interface.GROUND_TRUTH),
    interface.LESSON,
)


class InProcessRecord:
    """Writes the messages that the nodes would publish."""

    def __init__(self, writer: BagWriter, plant: Plant, controller: Controller) -> None:
        self._writer = writer
        self._plant = plant
        self._controller = controller
        self._command, self._state = TwistStamped(), ControllerState()
        self._command.header.frame_id = self._state.header.frame_id = 'world'
        steps = controller.settings.horizon_steps
        self._horizon = HorizonMessage(steps, controller.horizon_step)
        self._truth = sim.GroundTruthMessage(plant.slider)
        self._sequence: dict[str, int] = {}
        self._ticks = self._lessons = 0
        for topic in interface.TOPICS:
            if topic.core or topic in ALSO_RECORDED:
                writer.add_topic(topic.absolute_name, topic.type_name, qos_text(topic.qos))

    def head(self, settings: MpcSettings, info: ModelInfo) -> None:
        """Writes plan and model, before the first tick."""
        stamp = to_stamp(nanoseconds(self._plant.START))
        plan = mpc.nominal_message(self._controller.plan, settings)
        plan.header.stamp = stamp
        self._write(interface.NOMINAL_TRAJECTORY, plan)
        self._write(interface.MODEL_INFO, model_info_message(info, stamp))

    def lessons(self, messages: Sequence[Lesson], models: Sequence[ModelInfo]) -> None:
        """Writes what laps have taught that is not written yet, and the models of it."""
        for message, info in zip(messages[self._lessons :], models[self._lessons :], strict=True):
            message.header.stamp = stamp = to_stamp(nanoseconds(self._plant.time))
            self._write(interface.LESSON, message)
            self._write(interface.MODEL_INFO, model_info_message(info, stamp))
        self._lessons = len(messages)

    def tick(self, seen: Observation | None, tick: Tick, tick_ms: float) -> None:
        """Writes one tick: measurement, ground truth, command and state of the controller."""
        observation = seen or self._plant.without_picture()
        stamp_ns = nanoseconds(observation.time)
        stamp = to_stamp(stamp_ns)
        self._write(interface.PUSHER_POSE, sim.position_message(observation.tip_position, stamp))
        self._write(interface.OBJECT_POSE, sim.pose_message(observation.object_pose, stamp))
        if seen is not None:
            self._write(interface.GROUND_TRUTH, self._truth.of(observation.truth, stamp))
        for applied in self._plant.take_perturbations():
            happened = to_stamp(nanoseconds(applied.time))
            self._write(interface.PERTURBATION, sim.perturbation_message(applied, happened))
        self.controller_tick(tick, stamp_ns, tick_ms)

    def controller_tick(self, tick: Tick, stamp: int, tick_ms: float) -> None:
        """Writes what the controller publishes in a tick, with a stamp [ns]."""
        self._write_command(tick, stamp)
        self._write_state(tick, stamp, tick_ms)

    def _write_command(self, tick: Tick, stamp: int) -> None:
        if tick.mode != Mode.IDLE:
            mpc.set_stamp(self._command, stamp)
            mpc.fill_command(self._command, tick.velocity)
            self._write(interface.PUSHER_VELOCITY_CMD, self._command)

    def _write_state(self, tick: Tick, stamp: int, tick_ms: float) -> None:
        mpc.set_stamp(self._state, stamp)
        mpc.fill_state(self._state, tick)
        self._state.tick = self._ticks
        self._state.tick_ms = tick_ms
        self._state.stop_reason = self._controller.stop_reason
        self._state.model_id = self._controller.model_id
        self._write(interface.CONTROLLER_STATE, self._state)
        self._ticks += 1
        self._write_horizon(tick, stamp)

    def _write_horizon(self, tick: Tick, stamp: int) -> None:
        if tick.planned is not None and self._ticks % HORIZON_EVERY == 0:
            self._write(interface.HORIZON, self._horizon.of(tick.planned, stamp))

    def _write(self, topic: GraphTopic, message: Any) -> None:
        now = nanoseconds(self._plant.time)
        sequence = self._sequence.get(topic.name, 0) + 1
        self._sequence[topic.name] = sequence
        self._writer.write(topic.absolute_name, serialize_message(message), now, now, sequence)
