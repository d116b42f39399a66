"""The simulator node: parameters, topics and services around a `Plant`."""

from collections.abc import Callable, Sequence

import numpy as np
from geometry_msgs.msg import TwistStamped
from push_core.common import InputError, PushError
from push_msgs.msg import NominalTrajectory
from push_msgs.srv import Perturb, Reset
from push_node import interface
from push_node.diagnostics import ERROR, WARN, Reporter, worst
from push_node.graph import second_source
from push_node.parameters import declared, on_change, override
from push_node.publishers import PUBLISHERS, GraphPublishers
from push_node.realtime import enter_realtime
from push_node.spin import run_node
from push_node.stamps import to_nanoseconds, to_stamp
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from std_srvs.srv import Trigger

from push_sim.node.conversions import (
    GroundTruthMessage,
    commanded_velocity,
    perturbation_message,
    pose_message,
    position_message,
)
from push_sim.node.node_settings import NodeSettings, is_changeable, node_settings
from push_sim.node.pace import LockstepPace, Pace, RealtimePace
from push_sim.node.viewer_messages import Transforms, scene_markers
from push_sim.plant import Observation, Perturbation, PerturbationKind, Plant

_SCENE_PERIOD = 0.05
_HEALTH_PERIOD = 1.0
_GRAPH_PERIOD = 0.1
_PACES: dict[
    str, Callable[[Node, Plant, GraphPublishers, Callable[[Observation], None]], Pace]
] = {
    'realtime': RealtimePace,
    'lockstep': LockstepPace,
}


class SimNode(Node):  # type: ignore[misc]
    """Publishes measured poses and executes velocity commands."""

    def __init__(self) -> None:
        super().__init__('sim_node', automatically_declare_parameters_from_overrides=True)
        defaults = node_settings(override(self, 'profile', 'irb120'))
        self._settings: NodeSettings = declared(self, defaults, is_changeable)
        self._slider = self._settings.slider
        self._plant = Plant(self._settings, self._slider)
        self._plan: NominalTrajectory | None = None
        self._conflict = ''
        self._late_told = 0
        self._outputs = PUBLISHERS[self._settings.mode](self)
        self._make_publishers()
        self._pace = _PACES[self._settings.mode](self, self._plant, self._outputs, self._publish)
        self._pace.restart(self._start())
        on_change(self, self._settings, self._plant.change)
        interface.PUSHER_VELOCITY_CMD.subscription(self, self._on_command)
        interface.NOMINAL_TRAJECTORY.subscription(self, self._on_plan)
        interface.RESET.service(self, self._on_reset)
        interface.RESET_TO_PLAN.service(self, self._on_reset_to_plan)
        interface.PERTURB.service(self, self._on_perturb)
        self.create_timer(_SCENE_PERIOD, self._publish_scene)
        self.create_timer(_HEALTH_PERIOD, self._report)
        # simulated time stands still without commands
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(_GRAPH_PERIOD, self._watch_graph, clock=steady)
        profile, mode = self._settings.profile, self._settings.mode
        scheduling = enter_realtime(mode, self._settings.realtime)
        self.get_logger().info(f'{profile}, {mode}; {scheduling.text}')
        if scheduling.warning:
            self.get_logger().warning(scheduling.warning)

    def destroy_node(self) -> None:
        """Also closes the plant."""
        self._outputs.flush()
        super().destroy_node()
        self._plant.close()

    def _make_publishers(self) -> None:
        # before the poses: a recorder that has discovered the poses has then discovered it too
        publisher = self._outputs.of
        self._truth = publisher(interface.GROUND_TRUTH)
        self._truth_message = GroundTruthMessage(self._slider)
        self._object = publisher(interface.OBJECT_POSE)
        self._pusher = publisher(interface.PUSHER_POSE)
        self._perturbation = publisher(interface.PERTURBATION)
        self._scene = publisher(interface.SCENE_MARKERS)
        self._tf = publisher(interface.TRANSFORMS)
        self._frames = Transforms(self.get_namespace())
        self._reporter = Reporter(self, 'plant')

    def _start(self) -> Observation:
        start = self._settings.start
        tip = start.tip_position(self._slider)
        return self._plant.reset(start.object_pose, tip, self._settings.seed)

    def _publish(self, observation: Observation) -> None:
        stamp = to_stamp(self._pace.stamp(observation.time))
        # the tip first, so that a subscriber that waits for the object's pose has both
        self._pusher.publish(position_message(observation.tip_position, stamp))
        self._object.publish(pose_message(observation.object_pose, stamp))
        if observation.shows_object:
            self._truth.publish(self._truth_message.of(observation.truth, stamp))
            self._tf.publish(
                self._frames.at(observation.object_pose, observation.tip_position, stamp)
            )
        for applied in self._plant.take_perturbations():
            happened = to_stamp(self._pace.stamp(applied.time))
            self._perturbation.publish(perturbation_message(applied, happened))

    def _watch_graph(self) -> None:
        conflict = second_source(self)
        if conflict == self._conflict:
            return
        self._conflict = conflict
        self._report()
        if conflict:
            self.get_logger().error(f'{conflict}; the driver brakes')

    def _on_command(self, message: TwistStamped) -> None:
        # of two sources neither is right: without commands the driver brakes
        if self._conflict:
            return
        stamp = to_nanoseconds(message.header.stamp)
        self._pace.command(commanded_velocity(message), stamp)

    def _on_reset(self, request: Reset.Request, response: Reset.Response) -> Reset.Response:
        try:
            pose, tip = np.array(request.object_pose), np.array(request.tip_position)
            self._pace.restart(self._plant.reset(pose, tip, request.seed))
        except PushError as error:
            response.message = str(error)
            return response
        response.success, response.message = True, 'at rest'
        return response

    def _on_plan(self, message: NominalTrajectory) -> None:
        lines = (message.x, message.y, message.theta, message.p_y)
        whole = all(lines) and len({len(line) for line in lines}) == 1
        if whole and np.isfinite([line[0] for line in lines]).all():
            self._plan = message
        else:
            self.get_logger().error(f'{interface.NOMINAL_TRAJECTORY.name}: no plan, ignored')

    def _on_reset_to_plan(
        self, _request: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        plan, topic = self._plan, interface.NOMINAL_TRAJECTORY.name
        if plan is None:
            response.message = f'no plan on {topic} yet; is mpc_node running?'
            return response
        pose = np.array([plan.x[0], plan.y[0], plan.theta[0]])
        tip = self._slider.tip_position(pose, plan.p_y[0])
        reset = Reset.Request(object_pose=pose, tip_position=tip, seed=self._settings.seed)
        answer = self._on_reset(reset, Reset.Response())
        response.success, response.message = answer.success, answer.message
        if answer.success:
            response.message = f'at rest at the start of {plan.track}, tip in contact'
        return response

    def _on_perturb(
        self, request: Perturb.Request, response: Perturb.Response
    ) -> Perturb.Response:
        try:
            self._plant.perturb(_perturbation(request))
        except PushError as error:
            response.message = str(error)
            return response
        response.success, response.message = True, 'applied'
        return response

    def _publish_scene(self) -> None:
        plant, stamp = self._plant, to_stamp(self._pace.stamp(self._plant.time))
        self._scene.publish(
            scene_markers(self._slider, plant.object_pose, plant.tip_position, stamp)
        )

    def _report(self) -> None:
        values = {
            'profile': self._settings.profile,
            'mode': self._settings.mode,
            'plant_time_s': f'{self._plant.time:.2f}',
            'late_frames': str(self._pace.late_frames),
            'contact': str(self._plant.contact).lower(),
            'watchdog': 'holds' if self._plant.braking else 'fed',
            **{f'limited_{name}': str(n) for name, n in sorted(self._plant.limited.items())},
        }
        conflict = f'{self._conflict}; the driver brakes' if self._conflict else ''
        late, self._late_told = self._pace.late_frames - self._late_told, self._pace.late_frames
        dropped = f'{late} exposures dropped: the process ran too late' if late else ''
        self._reporter.report(*worst([(ERROR, conflict), (WARN, dropped)], 'running'), values)


def _perturbation(request: Perturb.Request) -> Perturbation:
    if request.kind not in list(PerturbationKind):
        raise InputError(
            f'kind is {request.kind}, must be one of {[int(kind) for kind in PerturbationKind]}'
        )
    return Perturbation(PerturbationKind(request.kind), request.magnitude, request.angle)


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the node."""
    return run_node(SimNode, argv)


if __name__ == '__main__':
    raise SystemExit(main())
