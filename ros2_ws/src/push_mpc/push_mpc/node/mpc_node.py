"""The controller node: poses in, a tip velocity out, every 10 ms."""

import math
import sys
import time
from collections.abc import Callable, Sequence
from functools import partial

from push_core.geometry import Array
from push_node import interface
from push_node.diagnostics import ERROR, WARN, Reporter, worst
from push_node.parameters import declared, on_change, override
from push_node.realtime import Scheduling, enter_realtime
from push_node.spin import run_node
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from std_srvs.srv import Trigger

from push_mpc.estimate import PoseGate
from push_mpc.loop import MOVING, Controller, Mode, Tick, here_fault, start_fault
from push_mpc.node import conversions
from push_mpc.node.graph_watch import GraphWatch
from push_mpc.node.horizon_message import HorizonMessage
from push_mpc.node.lap_gate import LapGate
from push_mpc.node.link_watch import LinkWatch
from push_mpc.node.loop_health import LoopHealth, stop_finding
from push_mpc.node.mode_log import ModeLog
from push_mpc.node.model_client import ModelClient
from push_mpc.node.pose_pair import PosePair
from push_mpc.node.preparation import Preparation
from push_mpc.node.recorder_watch import RecorderWatch
from push_mpc.node.tick_output import TickOutput
from push_mpc.node.watchdog import Watchdog
from push_mpc.plan import check_pushes, planned
from push_mpc.settings import MpcSettings, is_changeable, mpc_settings
from push_mpc.table import Tabulated

REPORT_PERIOD = 1.0  # [s]
LESSON_PERIOD = 0.02  # [s] between two looks for a lesson that the plant waits for
GRAPH_PERIOD = 0.2  # [s] between two looks at other commanders and the recorder
_ACTIVE = (*MOVING, Mode.STOPPING)
ON_REQUEST = 'stopped on request'
_LATE = 1.5  # periods without a tick, from which one without poses takes its place
_IGNORED = 25  # repetitions of a pose, each 0.2 s after the last, that no command has ended
_NOT_TAKEN = (
    'the plant repeats its pose and takes no command for it; '
    'commands carry the stamp of the pose: does something change the stamps?'
)
_NOT_AT_REST = 'the tip is not at rest yet'


class MpcNode(Node):  # type: ignore[misc]
    """Topics, services and timers around one `Controller`."""

    def __init__(self) -> None:
        super().__init__('mpc_node', automatically_declare_parameters_from_overrides=True)
        bundles = override(self, 'profile', 'irb120'), override(self, 'preset', 'tuned')
        self._settings = declared(self, mpc_settings(*bundles), is_changeable)
        self._lockstep = self._settings.mode == 'lockstep'
        self._controller = Controller(
            self._settings, self._settings.slider, planned(self._settings)
        )
        self._gate = PoseGate(self._settings.poses, self._settings.limits)
        tolerance = None if self._lockstep else self._settings.poses.pair_tolerance
        self._poses = PosePair(
            self, self._gate, tolerance, self._tick, self._coast, self._refused, self._repeat
        )
        self._graph = GraphWatch(self)
        self._mode_log = ModeLog()
        self._extrapolations = self._repeats = 0
        self._ticked = -math.inf
        self._table: Tabulated | None = None
        self._scheduling: Scheduling | None = None
        horizon = HorizonMessage(self._settings.horizon_steps, self._controller.horizon_step)
        self._output = TickOutput(self, self._settings.mode, horizon)
        self._preparation = Preparation(self._settings, self._controller)
        self._model = ModelClient(self, self._settings, self._preparation.prepare)
        self._laps = LapGate(
            self._controller.plan.duration, self._settings.laps, self._settings.speed
        )
        self._postponed: Callable[[], None] | None = None
        self._recorder = RecorderWatch(self)
        self._link = (
            None if self._lockstep else LinkWatch(self, self._settings.poses.clock_tolerance)
        )
        self._way = 0.0
        self._watchdog = Watchdog(self._settings.period)
        self._reporter = Reporter(self, 'control')
        self._health, self._reported = LoopHealth(self._settings.period), time.monotonic()
        on_change(self, self._settings, self._on_change, self._check_change)
        self._nominal = interface.NOMINAL_TRAJECTORY.publisher(self)
        self._announce_plan()
        self._offer_services()
        self._start_timers()

    def destroy_node(self) -> None:
        """Leaves the tip at rest."""
        if self._controller.mode in _ACTIVE:
            self._halt('the controller was shut down')
        while self._controller.mode == Mode.STOPPING:
            time.sleep(self._settings.period)
            self._slow_down()
        self._output.flush()
        self._preparation.close()
        self._model.close()
        super().destroy_node()

    def _check_change(self, settings: MpcSettings) -> None:
        check_pushes(self._controller.plan, settings)

    def _on_change(self, settings: MpcSettings) -> None:
        self._settings = settings
        self._controller.change(settings)

    def _announce_plan(self) -> None:
        """Publishes the plan where it lies now."""
        plan = conversions.nominal_message(self._controller.plan, self._settings)
        plan.header.stamp = self.get_clock().now().to_msg()
        self._nominal.publish(plan)

    def _offer_services(self) -> None:
        interface.START.service(self, self._on_start)
        interface.STOP.service(self, self._on_stop)
        interface.RESUME.service(self, self._on_resume)

    def _start_timers(self) -> None:
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(REPORT_PERIOD, self._report, clock=steady)
        self.create_timer(GRAPH_PERIOD, self._watch_others, clock=steady)
        watch = self._watch_lockstep if self._lockstep else self._watch
        self.create_timer(self._watchdog.period, watch, clock=steady)
        if self._lockstep and self._settings.learn:
            self.create_timer(LESSON_PERIOD, self._go_on, clock=steady)

    def _tick(self, stamp: int, exposure: float, now: float) -> None:
        """Handles a pair of poses: stamp of the exposure [ns], exposure and current time [s]."""
        # the command counts from when it reaches the driver
        then = now + self._way
        self._answer(stamp, then, lambda: self._controller.step(*self._measured(), exposure, then))

    def _coast(self, stamp: int, now: float) -> None:
        """Goes on without new poses, with a stamp [ns] and the current time [s]."""
        then = now + self._way
        self._answer(stamp, then, lambda: self._controller.coast(then))

    def _answer(self, stamp: int, now: float, step: Callable[[], Tick]) -> None:
        """Computes and publishes a tick whose command counts from a time [s]."""
        self._repeats = 0
        if self._lockstep and self._untaught and self._controller.mode in MOVING:
            self._postponed = partial(self._answer, stamp, now, step)
            return
        self._postponed = None
        arrived, self._ticked = time.perf_counter(), time.monotonic()
        self._take_model()
        tick = self._computed(step, now)
        self._laps.note(tick)
        if tick.mode != Mode.IDLE:
            self._output.command(tick.velocity, stamp)
        self._tell(tick, stamp, 1e3 * (time.perf_counter() - arrived))
        self._output.horizon(tick.planned, stamp)
        self._extrapolations += self._extrapolates(tick)
        self._output.step()
        self._controller.prepare_next()

    @property
    def _untaught(self) -> bool:
        """Whether the last lap or piece has not taught yet."""
        return self._settings.learn and self._model.taught.lacks(self._laps.expected)

    def _go_on(self) -> None:
        """Answers poses that waited for a lesson, when that is there."""
        if self._postponed is not None and not self._untaught:
            self._postponed()

    def _computed(self, step: Callable[[], Tick], now: float) -> Tick:
        """One tick; of one that raises, the first of a stop."""
        try:
            return step()
        except Exception as error:  # noqa: BLE001  whatever it is, the tip must come to rest
            self._controller.fail(f'a tick raised {error!r}')
            return self._controller.hold(now)

    def _measured(self) -> tuple[Array, Array]:
        """Newest object pose (3,) and tip position (2,)."""
        poses = self._poses
        return conversions.planar_pose(poses.object_pose), conversions.position(poses.tip)

    def _refused(self, reason: str) -> None:
        """Stops on a refused pose in lockstep, where the plant waits for an answer."""
        if self._lockstep and self._controller.mode in _ACTIVE:
            self._halt(reason)

    def _watch_others(self) -> None:
        """Stops when another node commands the tip or none records; writes the mode log."""
        fault = self._graph.warning() or self._unrecorded()
        if fault and self._controller.mode in MOVING:
            self._halt(fault)
        self._mode_log.write(self.get_logger())
        if self._link is not None:
            self._link.poll()

    def _unrecorded(self) -> str:
        """Why nothing is recorded although it must be, empty if it is."""
        return self._recorder.failure() if self._settings.require_recorder else ''

    def _repeat(self) -> None:
        """Sends the last command again: the simulator did not receive it."""
        if self._postponed is not None:
            return
        self._repeats += 1
        if self._repeats > _IGNORED and self._controller.mode in MOVING:
            self._halt(_NOT_TAKEN)
        if self._controller.mode != Mode.IDLE:
            self._output.repeat_command()

    def _tell(self, tick: Tick, stamp: int, tick_ms: float) -> None:
        """Publishes the record of a tick, and notes it for log and diagnostics."""
        controller = self._controller
        self._mode_log.note(tick.mode, controller.stop_reason)
        self._health.note(tick, tick_ms)
        self._output.state(tick, stamp, tick_ms, controller.stop_reason, controller.model_id)

    def _take_model(self) -> None:
        ready = self._model.ready
        if ready is not None and ready.model_id != self._controller.model_id:
            self._controller.use(ready)
            self._table = self._model.table

    def _extrapolates(self, tick: Tick) -> bool:
        """Whether the command relies on the model outside its training data."""
        if self._table is None or tick.predicted is None or tick.input is None:
            return False
        v_n, v_t = tick.input
        return bool(tick.velocity.any()) and not self._table.data.covers(
            tick.predicted[3], math.atan2(v_n, v_t)
        )

    def _watch(self) -> None:
        """Goes on without poses when they are late, and stops when none come any more."""
        now, mode, age = time.monotonic(), self._controller.mode, self._poses.age
        late = now - self._ticked > _LATE * self._settings.period
        if self._watchdog.slept(now) or mode not in _ACTIVE or not late:
            return
        if age > self._settings.pose_loss and mode in MOVING:
            why = self._poses.explanation()
            self._halt(f'no pose for {1e3 * age:.0f} ms' + (f': {why}' if why else ''))
        elif mode != Mode.ARMED:
            self._coast(*self._poses.now())

    def _watch_lockstep(self) -> None:
        """Ends a stop for which the plant no longer sends poses."""
        stopping = self._controller.mode == Mode.STOPPING and self._controller.stop_reason
        if stopping and self._poses.age > self._settings.pose_loss:
            self._slow_down()

    def _halt(self, reason: str) -> None:
        """Stops without waiting for a pose."""
        self._controller.stop(reason)
        self._slow_down()
        self._mode_log.write(self.get_logger())

    def _slow_down(self) -> None:
        stamp, now = self._poses.now()
        self._publish(self._controller.hold(now + self._way), stamp)

    def _publish(self, tick: Tick, stamp: int) -> None:
        """Publishes a tick that answers no pose."""
        self._output.command(tick.velocity, stamp)
        self._tell(tick, stamp, 0.0)

    def _on_start(self, _request: Trigger.Request, answer: Trigger.Response) -> Trigger.Response:
        if self._controller.mode in MOVING:
            # a repeated request, whose first response was lost, must not restart the run
            answer.success, answer.message = True, 'already started'
            return answer
        self._take_model()
        answer.message = self._obstacle()
        answer.success = not answer.message
        if answer.success:
            scheduling = self._enter_realtime()
            self._way = self._link.way if self._link else 0.0
            self._arm()
            answer.message = f'armed; {scheduling.text}'
        return answer

    def _enter_realtime(self) -> Scheduling:
        """Asks the kernel once, when all that the loop needs is there; tells what it refused."""
        if self._scheduling is None:
            settings = self._settings
            self._scheduling = enter_realtime(settings.mode, settings.realtime)
            if self._scheduling.warning:
                self.get_logger().warning(self._scheduling.warning)
        return self._scheduling

    def _arm(self) -> None:
        if self._starts_here:
            self._controller.arm(self._measured()[0])
            self._announce_plan()
        else:
            self._controller.arm()
        self._poses.restart()
        self._laps.begin(self._model.taught)

    @property
    def _starts_here(self) -> bool:
        return self._settings.start_from == 'here'

    def _on_stop(self, _request: Trigger.Request, answer: Trigger.Response) -> Trigger.Response:
        self._halt(ON_REQUEST)
        answer.success = True
        answer.message = f'stopped; {interface.RESUME.name} releases the stop'
        return answer

    def _on_resume(self, _request: Trigger.Request, answer: Trigger.Response) -> Trigger.Response:
        self._controller.resume()
        answer.success = self._controller.mode != Mode.STOPPING
        released = f'released; {interface.START.name} begins anew'
        answer.message = released if answer.success else _NOT_AT_REST
        return answer

    def _obstacle(self) -> str:
        """Why the run cannot start, empty if it can."""
        if self._controller.stop_reason or self._controller.mode == Mode.STOPPING:
            reason, resume = self._controller.stop_reason, interface.RESUME.name
            return f'stopped: {reason}; call {resume} first' if reason else _NOT_AT_REST
        if not self._controller.model_id or self._untaught:
            return f'waiting for the model: {self._model.problem or "the last lap still teaches"}'
        if self._settings.require_recorder and self._recorder.obstacle:
            return self._recorder.obstacle
        rivals = self._graph.warning()
        if rivals:
            return f'{rivals}; stop it first'
        if not self._poses.fresh:
            why = self._poses.explanation()
            self._poses.rewind()
            return f'waiting for poses: {why}' if why else 'waiting for poses'
        return self._misplaced()

    def _misplaced(self) -> str:
        """Why the plan cannot begin with object and tip where they are, empty if it can."""
        object_pose, tip = self._measured()
        slider, plan = self._settings.slider, self._controller.track_plan
        if self._starts_here:
            fault = here_fault(slider, self._settings.limits, plan, object_pose, tip)
            advice = 'move the tip or the object'
        else:
            fault = start_fault(slider, plan.state[0], object_pose, tip)
            advice = f'put it there, in simulation with {interface.RESET_TO_PLAN.name}'
        return f'{fault}; {advice}' if fault else ''

    def _warning(self) -> str:
        """What is wrong while the controller is not stopped, empty if nothing is."""
        poses = '' if self._poses.fresh else self._poses.explanation()
        return self._model.problem or poses or self._graph.warning()

    def _report(self) -> None:
        now = time.monotonic()
        seconds, self._reported = now - self._reported, now
        findings, values = self._health.take(
            math.inf if self._lockstep else seconds, self._totals(), self._settings.diagnostics
        )
        reason = self._controller.stop_reason
        findings.append(stop_finding(reason, ON_REQUEST) if reason else (ERROR, self._warning()))
        if self._link is not None:
            findings.append((WARN, self._link.fault))
            values |= self._link.values()
        values |= {
            'mode': self._controller.mode.name.lower(),
            'model': self._controller.model_id,
            'table': str(self._table or ''),
            'ticks': str(self._output.ticks),
            'outside_training_data': str(self._extrapolations),
            'pose_age_ms': f'{1e3 * self._poses.age:.0f}',
        }
        self._reporter.report(*worst(findings, self._controller.mode.name.lower()), values)

    def _totals(self) -> dict[str, int]:
        return {
            'solver_failures': self._controller.solver_failures,
            'refused_frozen': self._controller.frozen_poses,
            **{f'refused_{kind}': count for kind, count in self._gate.counts.items()},
        }


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the controller until SIGINT or SIGTERM."""
    return run_node(MpcNode, argv)


if __name__ == '__main__':
    sys.exit(main())
