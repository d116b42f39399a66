"""What must hold in a random sequence: a witness of all messages, and the comparison of bags."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from geometry_msgs.msg import TwistStamped
from push_bag.file import BagReader
from push_bag.run import RunSeries, read_starts
from push_bag.score.score import score_series
from push_core.common import InputError
from push_core.physics import SafetyLimits
from push_msgs.msg import ControllerState, GroundTruth, NominalTrajectory, Perturbation
from push_node import interface
from push_node.stamps import to_nanoseconds
from rclpy.node import Node
from rclpy.qos import QoSProfile

PERIOD = 10_000_000  # [ns]
LARGEST_DEVIATION = 0.05  # [m]
TOLERANCE = 1e-6  # [m/s]
FOLLOWING = (ControllerState.TRACKING, ControllerState.RECONTACT)
# the nodes wait in lockstep until each message is here
DEEP = QoSProfile(depth=5000)
RUNNING = (
    *FOLLOWING,
    ControllerState.ARMED,
    ControllerState.HOLDING,
    ControllerState.STOPPING,
)


Tick = tuple[int, int, float]
"""Number, stamp [ns] and duration [ms] of a tick; the first two repeat where nodes begin anew."""


@dataclass
class SeenStart:
    """One start as its states told it.

    Attributes:
        ticks: in which it ran and answered a pose.
        rest: the first tick at rest; None without one.
        outcome: DONE, STOPPED or FAULT; None while it runs, or if its controller ended first.
        reason: of the stop.
        deviation: largest distance [m] of the object from the plan in a tick that follows it,
            after the reference has begun; None without such a tick.
        last: newest state.
    """

    ticks: set[Tick] = field(default_factory=set)
    rest: Tick | None = None
    outcome: int | None = None
    reason: str = ''
    deviation: float | None = None
    last: ControllerState | None = None

    @property
    def all_ticks(self) -> set[Tick]:
        """Those in which it ran, and the first at rest."""
        return self.ticks if self.rest is None else {*self.ticks, self.rest}


class Witness:
    """Hears all messages of a cell and notes what must not be.

    Attributes:
        armed: how many starts were accepted; counted by the caller.
        starts: that were seen.
        faults: what must not be, in words.
    """

    def __init__(self, node: Node) -> None:
        self.armed = 0
        self.starts: list[SeenStart] = []
        self.faults: list[str] = []
        self._limits = SafetyLimits()
        self._count, self._ended = -1, False
        self._command: tuple[int, np.ndarray] | None = None
        self._truth: tuple[int, np.ndarray] | None = None
        self._perturbed: set[int] = set()
        self._jumps: list[tuple[int, float]] = []
        self._plan: NominalTrajectory | None = None
        for topic, heard in (
            (interface.PUSHER_VELOCITY_CMD, self._on_command),
            (interface.CONTROLLER_STATE, self._on_state),
            (interface.GROUND_TRUTH, self._on_truth),
            (interface.PERTURBATION, self._on_perturbation),
        ):
            topic.subscription(node, heard, qos=DEEP)
        interface.NOMINAL_TRAJECTORY.subscription(node, self._on_plan)

    def jumps(self) -> list[str]:
        """Where the tip was faster than its limit, and no perturbation moved it."""
        return [
            f'the tip moved by {1e3 * moved:.3f} mm in one period'
            for stamp, moved in self._jumps
            if not any(stamp - PERIOD <= at <= stamp for at in self._perturbed)
        ]

    def has_seen_all(self) -> bool:
        """Whether each accepted start was seen."""
        return len(self.starts) >= self.armed

    def is_running(self) -> bool:
        """Whether each accepted start was seen, and the newest has not ended."""
        return self.has_seen_all() and bool(self.starts) and self.outcome is None

    @property
    def outcome(self) -> int | None:
        """Of the newest start; None while it runs."""
        return self.starts[-1].outcome if self.starts else None

    def last_state(self) -> str:
        """Mode, reference time and reason of the newest state of a start."""
        last = self.starts[-1].last if self.starts else None
        if last is None:
            return 'no start was seen'
        return f'mode {last.mode} at {last.reference_time:.2f} s {last.stop_reason}'

    def _on_plan(self, plan: NominalTrajectory) -> None:
        self._plan = plan

    def _on_perturbation(self, message: Perturbation) -> None:
        self._perturbed.add(to_nanoseconds(message.header.stamp))

    def _on_state(self, state: ControllerState) -> None:
        running = self.starts and self.starts[-1].outcome is None
        again, self._count = state.tick < self._count, state.tick
        if state.mode == ControllerState.ARMED and (again or not running or self._ended):
            self.starts.append(SeenStart())
        elif not running or again or self._ended:
            self._ended = True
            return
        self._ended = False
        self._note(self.starts[-1], state)

    def _note(self, start: SeenStart, state: ControllerState) -> None:
        start.last = state
        if state.mode not in RUNNING:
            start.rest = _tick_of(state)
            start.outcome, start.reason = int(state.mode), state.stop_reason
        elif state.tick_ms > 0.0:
            start.ticks.add(_tick_of(state))
        if state.mode in FOLLOWING and self._plan is not None:
            away = self._deviation(state)
            if state.reference_time > 0.0:
                start.deviation = max(start.deviation or 0.0, away)
            if away > LARGEST_DEVIATION:
                self.faults.append(
                    f'start {len(self.starts)} follows the plan {1e3 * away:.0f} mm away from it '
                    f'at {state.reference_time:.2f} s'
                )

    def _deviation(self, state: ControllerState) -> float:
        plan = self._plan
        assert plan is not None
        x, y = (np.interp(state.reference_time, plan.time, axis) for axis in (plan.x, plan.y))
        return float(np.hypot(state.state[0] - x, state.state[1] - y))

    def _on_command(self, message: TwistStamped) -> None:
        stamp = to_nanoseconds(message.header.stamp)
        velocity = np.array([message.twist.linear.x, message.twist.linear.y])
        if np.hypot(*velocity) > self._limits.speed + TOLERANCE:
            self.faults.append(f'a command of {np.hypot(*velocity):.4f} m/s')
        if self._command is not None and stamp == self._command[0] + PERIOD and velocity.any():
            change = np.hypot(*(velocity - self._command[1]))
            if change > self._limits.acceleration * 1e-9 * PERIOD + TOLERANCE:
                self.faults.append(f'the command changed by {change:.4f} m/s in one tick')
        self._command = stamp, velocity

    def _on_truth(self, message: GroundTruth) -> None:
        stamp, tip = to_nanoseconds(message.header.stamp), np.array(message.tip)
        if np.any(np.abs(tip) > [self._limits.workspace_x, self._limits.workspace_y]):
            self.faults.append(f'the tip is at {tip}, outside the workspace')
        if self._truth is not None and stamp == self._truth[0] + PERIOD:
            moved = float(np.hypot(*(tip - self._truth[1])))
            if moved > (self._limits.speed + TOLERANCE) * 1e-9 * PERIOD:
                self._jumps.append((stamp, moved))
        self._truth = stamp, tip


def compared(bags: list[Path], witness: Witness) -> Iterator[str]:
    """What the scores of bags tell otherwise than the witness of the same starts."""
    if len(witness.starts) != witness.armed:
        yield f'{witness.armed} starts were accepted, {len(witness.starts)} were seen'
    for bag in bags:
        try:
            recorded = _ticks_in(bag)
            series = read_starts(bag) if recorded else []
        except InputError as error:
            # a recorder that was killed at once
            if 'before its first message' not in str(error):
                yield f'{bag.name}: {error}'
            continue
        yield from (f'{bag.name}: {fault}' for fault in of_bag(recorded, series, witness.starts))


def _ticks_in(bag: Path) -> set[Tick]:
    """All ticks of the controller in a bag."""
    reader = BagReader(bag)
    records = [each for each in reader.records() if each.topic.name == '/controller_state']
    return {_tick_of(record.message()) for record in records}


def of_bag(recorded: set[Tick], series: list[RunSeries], starts: list[SeenStart]) -> Iterator[str]:
    """What the starts of one bag tell otherwise than the witness.

    Args:
        recorded: all ticks in the bag.
        series: starts in the bag.
        starts: that were seen.
    """
    scored = [_running_ticks(run) for run in series]
    for number, start in enumerate(starts, 1):
        found = [run for run, ticks in zip(series, scored, strict=True) if ticks & start.ticks]
        if len(found) != bool(recorded & start.ticks):
            yield f'start {number} is scored {len(found)} times'
        elif found and start.all_ticks <= recorded:
            faults = score_faults(score_series(found[0]), start)
            yield from (f'start {number} {fault}' for fault in faults)
    seen = set().union(*(start.ticks for start in starts))
    if any(ticks and not ticks & seen for ticks in scored):
        yield 'a start is scored that nobody saw'


def _running_ticks(run: RunSeries) -> set[Tick]:
    """The ticks in which a start ran and answered a pose."""
    duration = run.state('tick_ms')
    running = np.isin(run.state('mode'), RUNNING) & (duration > 0.0)
    ticks = run.state('tick')[running].astype(np.int64)
    stamps = run.states.stamp[running]
    return {*zip(ticks.tolist(), stamps.tolist(), duration[running].tolist(), strict=True)}


def _tick_of(state: ControllerState) -> Tick:
    return int(state.tick), to_nanoseconds(state.header.stamp), float(state.tick_ms)


def score_faults(score: dict[str, Any], start: SeenStart) -> Iterator[str]:
    """What the score of a start tells otherwise than the witness."""
    if start.outcome == ControllerState.STOPPED and score['stop_reason'] != start.reason:
        yield f'stopped: {start.reason}, but the score says {score["stop_reason"]}'
    last = start.last
    assert last is not None
    done = start.outcome == ControllerState.DONE
    if bool(score['completed']) != done and not (done and abs(last.gap) > 1e-3):
        yield f'has outcome {start.outcome}, but the score says completed {score["completed"]}'
    away, largest = start.deviation, score['tracking_error_mm']['max']
    if away is None or largest is None:
        if away is not largest:
            yield f'was {away} m away, but the score says {largest} mm'
    elif abs(largest - 1e3 * away) > 0.5:
        yield f'was {1e3 * away:.2f} mm away, but the score says {largest:.2f} mm'
