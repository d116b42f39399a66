"""The controller: poses in, tip velocities out; no ROS, and time is an argument."""

import math
from dataclasses import replace

import numpy as np
from push_core.geometry import Array, rotation
from push_core.physics import Slider, limit, slowed

from push_mpc.estimate import FaceEstimator, ObjectFilter, Predictor
from push_mpc.loop.guard import Guard
from push_mpc.loop.modes import FOLLOWING, Event, Mode, ModeMachine
from push_mpc.loop.prepared_model import PreparedModel, at_speed
from push_mpc.loop.reference_clock import ReferenceClock
from push_mpc.loop.tick import Tick
from push_mpc.loop.tracker import Tracker
from push_mpc.motion import TravelMotion
from push_mpc.plan import Lesson, Placement, Plan, agreeing_plan
from push_mpc.qp import Move, Problem
from push_mpc.settings import ControllerSettings, approach, departure, is_apart
from push_mpc.table import Table

_STILL = np.zeros(2)
_FARTHEST = 1e3  # [m], [rad]; a larger pose is a measurement fault


class Controller:
    """Model-predictive tracking of a plan with a tabulated model.

    Attributes:
        plan: that is followed: that of the track, or the same moved to where the object lies.
        track_plan: as it was given.
    """

    def __init__(self, settings: ControllerSettings, slider: Slider, plan: Plan) -> None:
        self.settings = settings
        self.plan = self.track_plan = plan
        self._machine = ModeMachine()
        self._slider = slider
        self._predictor = Predictor(settings.actuator, slider, settings.command_timeout)
        self._guard = Guard(settings, slider)
        self._filter = ObjectFilter(settings.filter_length(plan.speed), slider)
        self._face = FaceEstimator(slider)
        self._tracker = Tracker(settings, slider, plan)
        self._model: PreparedModel | None = None
        self._along_track: PreparedModel | None = None
        self._placement: Placement | None = None
        self._sent = _STILL
        self._seen = 0
        self._tip = self._touching = _STILL
        self._exposure = -math.inf
        self._pose_age = 0.0
        self._reference = ReferenceClock()
        self._failures_in_a_row = 0
        self.solver_failures = 0

    @property
    def mode(self) -> Mode:
        """The mode, see `push_mpc.loop.modes`."""
        return self._machine.mode

    @property
    def stop_reason(self) -> str:
        """Why the run stopped, empty if it did not."""
        return self._machine.reason

    @property
    def frozen_poses(self) -> int:
        """Ticks with the same poses as before while the tip was commanded, since the start."""
        return self._guard.frozen

    @property
    def model_id(self) -> str:
        """Id of the model in use, empty without one."""
        return self._model.model_id if self._model else ''

    @property
    def horizon_step(self) -> float:
        """Time between the states of the horizon [s]."""
        return self._tracker.horizon_step

    @property
    def problems(self) -> tuple[Problem, ...]:
        """The QPs of the latest tick; after a stop by the solver those that it did not solve."""
        return self._tracker.problems

    def prepare_model(
        self, table: Table, model_id: str, lesson: Lesson | None = None
    ) -> PreparedModel:
        """Plans with a model and computes what the QPs need; safe to call in another thread.

        Args:
            table: the model.
            model_id: of model and lesson.
            lesson: what laps have taught, None before the first.
        """
        lesson = lesson or Lesson()
        known = lesson.slider
        table, slider = at_speed(
            table,
            self.settings,
            known or self._slider,
            self.track_plan.speed,
            identified=known is not None,
        )
        plan = lesson.reference(self.track_plan)
        if self.settings.consistent_plan:
            motion = TravelMotion(table, self._slider.tip_x)
            plan = agreeing_plan(plan, motion, self._slider, slider if known else None) or plan
        staged = self._tracker.staged(table, plan, slider)
        return PreparedModel(table, plan, staged, model_id, slider)

    def use(self, model: PreparedModel) -> None:
        """Uses a prepared model from the next tick on; the first one also warms the solver up."""
        first = self._model is None
        # limits may have changed since it was prepared
        model = self._along_track = replace(model, staged=self._tracker.use(model))
        self._model = model.placed(self._placement) if self._placement else model
        if first:
            self._warm_up()

    def change(self, settings: ControllerSettings) -> None:
        """Uses other settings from the next tick on; call it between two ticks.

        Only weights, speed limits, recontact settings and filter length may differ: plan and
        sparsity of the QP are made of the others.
        """
        self.settings = settings
        self._tracker.change(settings)
        self._guard.change(settings)
        if self._model is not None and self._along_track is not None:
            sample = self._tracker.unload()
            self.use(self._along_track)
            self._tracker.prepare(self._model, sample)
            if self.mode not in FOLLOWING:
                self._warm_up()
        length = settings.filter_length(self.plan.speed)
        if length != self._filter.length:
            self._filter.change(length)

    def arm(self, start: Array | None = None) -> None:
        """Holds the tip at rest until enough poses have arrived, then tracks the plan.

        Args:
            start: pose (3,) of the object at which the plan begins; None for that of the track.
        """
        if not self._machine.take(Event.START):
            return
        self._place(start)
        self._seen = 0
        self._sent = _STILL
        self._reference.reset()
        self._failures_in_a_row = 0
        self._predictor.reset()
        self._filter.reset()
        self._exposure = -math.inf
        self._guard.reset()
        self._face.reset()
        self._warm_up()

    def _place(self, start: Array | None) -> None:
        """Moves plan and QP data; before the run, since it takes time by the length of both."""
        if start is None and self._placement is None:
            return
        origin = self.track_plan.state[0, :3]
        self._placement = None if start is None else Placement(origin, start)
        self.plan = self._placement.of(self.track_plan) if self._placement else self.track_plan
        if self._along_track is not None:
            self.use(self._along_track)
        self._tracker.unload()

    def stop(self, reason: str) -> None:
        """Brings the command to zero; the stop latches until `resume`, and so does its reason."""
        self._machine.take(Event.STOP, reason)
        self._rest_if_still()

    def fail(self, reason: str) -> None:
        """Brings the command to zero for a fault of the controller; latches like a stop."""
        self._machine.take(Event.FAIL, reason)
        self._rest_if_still()

    def hold(self, now: float) -> Tick:
        """Slows down to zero at a time [s], for want of a fresh pose; `step` continues.

        While the controller comes to rest after a stop, this continues without a pose, too.
        """
        self._machine.take(Event.LATE)
        return self._slow_down(Tick(self.mode, _STILL, now=now), now)

    def coast(self, now: float) -> Tick:
        """One tick at a time [s] without new poses: continues with the newest estimate.

        Poses older than `pose_timeout` no longer serve; then it holds. The run ends when it would
        with poses, whose exposures are as old as the last one was.
        """
        over = self._reference.at(now - self._pose_age) >= self.plan.duration
        if over and self.mode in FOLLOWING:
            self._machine.take(Event.END)
        if self.mode not in FOLLOWING or now - self._exposure > self.settings.pose_timeout:
            return self.hold(now)
        tick = self._commanded(self._follow(now), now)
        tick.now = now
        return tick

    def resume(self) -> None:
        """Releases a stop."""
        self._machine.take(Event.RESUME)

    def step(self, object_pose: Array, tip: Array, exposure: float, now: float) -> Tick:
        """One tick.

        Args:
            object_pose: measured pose (3,), world frame.
            tip: measured tip position (2,) [m], world frame.
            exposure: when both were measured [s].
            now: when the command will be sent [s].

        Returns:
            The command and the record of the tick.
        """
        self._pose_age = now - exposure
        tick = self._step(object_pose, tip, exposure, now)
        tick.exposure, tick.now = exposure, now
        return tick

    def _step(self, object_pose: Array, tip: Array, exposure: float, now: float) -> Tick:
        if not all(abs(value) < _FARTHEST for value in (*object_pose, *tip)):
            self.stop('a pose is not finite or implausibly far away')
            return self._slow_down(Tick(self.mode, _STILL), now)
        if self.mode == Mode.ARMED:
            self._count_poses(now)
        self._machine.take(Event.POSE)
        patience = max(self.settings.guard.catch_up, self.settings.pose_timeout)
        late = self._reference.is_late(exposure, patience) or self._predictor.has_braked(now)
        if late and self.mode in FOLLOWING:
            acts_at = now + self._predictor.horizon
            self._reference.go_on(self.plan, object_pose[:2], exposure, acts_at)
        running = self.mode in FOLLOWING
        self._see(object_pose, tip, exposure)
        tick = self._commanded(self._follow(now), now)
        tick.state = self._state(object_pose, tip)
        tick.gap = self._slider.gap(object_pose, self._face.touching(object_pose, tip))
        if running:
            tick.reference_time = self._reference.at(exposure)
            tick.innovation = self._filter.innovation
            tick.innovation_deviation = self._filter.deviation
        return tick

    def _see(self, object_pose: Array, tip: Array, exposure: float) -> None:
        """Updates the estimate, and ends a run that is over or cannot go on."""
        self._tip = self._touching = tip
        self._exposure = exposure
        if self.mode == Mode.ARMED:
            self._filter.settle(object_pose, tip, exposure)
        if self.mode not in FOLLOWING or self._model is None:
            return
        self._face.observe(object_pose, tip)
        self._touching = self._face.touching(object_pose, tip)
        self._filter.observe(self._model.table, object_pose, self._touching, exposure)
        reference_time = self._reference.at(exposure)
        if reference_time >= self.plan.duration:
            self._machine.take(Event.END)
        else:
            self._watch(object_pose, tip, reference_time, exposure)

    def _commanded(self, tick: Tick, now: float) -> Tick:
        """The tick with what its mode permits as command, which the predictor remembers."""
        if self.mode not in FOLLOWING:
            return self._slow_down(tick, now)
        self._remember(tick.velocity, now)
        return tick

    def _warm_up(self) -> None:
        """Solves at the start of the plan, so that a run depends on none before it."""
        if self._model is not None:
            self._tracker.forget()
            self._tracker.unload()
            self._solve(self._model.plan.state[0], 0.0)

    def _slow_down(self, tick: Tick, now: float) -> Tick:
        """Makes a tick one that slows the tip down, and ends a stop that is at rest."""
        period = self.settings.period
        tick.velocity, tick.limited = slowed(self._sent, self.settings.limits, period)
        tick.input = None if tick.velocity.any() else _STILL
        tick.planned = None
        self._remember(tick.velocity, now)
        self._rest_if_still()
        tick.mode = self.mode
        return tick

    def _rest_if_still(self) -> None:
        if not self._sent.any():
            self._machine.come_to_rest()

    def _remember(self, velocity: Array, now: float) -> None:
        """Records a command for the predictor; before and after tracking all are zero."""
        self._sent = velocity
        if self.mode in (*FOLLOWING, Mode.HOLDING):
            self._predictor.sent(velocity, now)

    def prepare_next(self) -> None:
        """Prepares the next tick's QP as far as it needs no pose; call it after sending."""
        if self.mode == Mode.TRACKING and self._model is not None:
            self._tracker.prepare_next(self._model)

    def _count_poses(self, now: float) -> None:
        self._seen += 1
        if self._seen > self.settings.good_poses:
            self._machine.take(Event.READY)
            self._reference.start = now + self._predictor.horizon

    def _follow(self, now: float) -> Tick:
        """Predicts from the newest estimate, tracks the reference and limits the command."""
        if self.mode not in FOLLOWING or self._model is None:
            return Tick(self.mode, _STILL)
        pose, tip, acts_at = self._filter.pose, self._touching, self._exposure
        if self.settings.delay_compensation:
            acts_at = now + self._predictor.horizon
            pose, tip = self._predictor.predict(
                self._model.table, self._filter.rate, pose, tip, self._exposure, acts_at
            )
        predicted, gap = self._state(pose, tip), self._slider.gap(pose, tip)
        self._watch_contact(gap)
        tick = self._move(predicted, gap, self._reference.at(acts_at))
        tick.disturbance, tick.estimate = self._filter.rate, self._filter.pose
        self._limit(tick, predicted[2], self._tip)
        return tick

    def _watch(
        self, object_pose: Array, tip: Array, reference_time: float, exposure: float
    ) -> None:
        """Stops a run that cannot go on."""
        reference = self.plan.at(reference_time)[0][:2]
        commanded = bool(self._sent.any())
        fault = self._guard.fault(object_pose, tip, reference, commanded, exposure)
        if fault:
            self.stop(fault)

    def _watch_contact(self, predicted_gap: float) -> None:
        """Switches between tracking and recontact, by the estimated and the predicted gap [m]."""
        pose, tip = self._filter.pose, self._touching
        gap = self._slider.gap(pose, tip)
        left = departure(self._slider, gap, self._slider.contact_offset(pose, tip))
        if left:
            self.stop(left)
            return
        was_apart = self.mode == Mode.RECONTACT
        # the smaller of both: a gap that is closing, or only predicted, needs no approach
        apart = is_apart(self.settings.recontact, min(gap, predicted_gap), was_apart)
        self._machine.take(Event.APART if apart else Event.TOUCH)

    def _move(self, predicted: Array, gap: float, reference_time: float) -> Tick:
        """Approaches the face, or solves the QP, for a predicted state and reference time [s]."""
        assert self._model is not None
        if self.mode != Mode.RECONTACT:
            return self._solve(predicted, reference_time)
        self._tracker.forget()
        reference, nominal = self._model.plan.at(reference_time)
        velocity = approach(self.settings.recontact, self._slider, gap, predicted[3], reference[3])
        tick = Tick(self.mode, _STILL, predicted=predicted, reference=reference, input=velocity)
        tick.nominal_input = nominal
        return tick

    def _state(self, object_pose: Array, tip: Array) -> Array:
        return np.array([*object_pose, self._slider.contact_offset(object_pose, tip)])

    def _solve(self, state: Array, reference_time: float) -> Tick:
        """Solves the QP for a state (4,) at a reference time [s]."""
        assert self._model is not None
        rate, sent = self._filter.rate, self._sent
        tick, move = self._tracker.solve(self._model, state, reference_time, rate, sent)
        tick.mode = self.mode
        self._count_failure(move)
        return tick

    def _count_failure(self, move: Move) -> None:
        """Fails after too many ticks in a row without a usable input, or in the warm-up."""
        self._failures_in_a_row = 0 if move.usable else self._failures_in_a_row + 1
        if move.usable:
            return
        self.solver_failures += 1
        in_a_row = self._failures_in_a_row
        if self.mode not in FOLLOWING or in_a_row >= self.settings.guard.solver_failures:
            self.fail(
                f'the solver found no usable input in {in_a_row} ticks in a row '
                f'(status {move.status}): {move.fault}'
            )

    def _limit(self, tick: Tick, heading: float, tip: Array) -> None:
        """Turns the input into a world velocity within the limits; without one slows down."""
        if tick.input is None:
            limits, period = self.settings.limits, self.settings.period
            tick.velocity, tick.limited = slowed(self._sent, limits, period)
            return
        turn = rotation(heading)
        desired = turn @ tick.input
        tick.velocity, tick.limited = limit(
            desired, self._sent, tip, self.settings.limits, self.settings.period
        )
        tick.input = turn.T @ tick.velocity
