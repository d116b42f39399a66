"""Runs cells whose cameras have another clock than the controller, and checks what follows.

Stamps that are off by 20 ms to an hour, before the start or from one moment of the run on, that
drift, and nodes in lockstep beside nodes in real time. What must hold: nothing hangs, and the
object is either within 20 mm of where it should be or the run does not begin or stops, with the
cause in one line.
"""

import argparse
import os
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from graph_by_hand import GraphByHand
from push_bringup.faults.relay import Relay, remappings
from push_core.common import Parser, RunError, run_command
from push_msgs.msg import ControllerState, GroundTruth, NominalTrajectory
from push_node import interface
from push_node.stamps import to_nanoseconds, to_stamp
from rclpy.qos import QoSProfile

LARGEST_ERROR = 0.02  # [m]
ATTEMPTS = 300  # to start, a tenth of a second apart; the nodes need some time
REFUSED = 20  # attempts in a row that were refused for the clock
LONGEST_RUN = 240.0  # [s] on a busy machine
MOMENT = 1.0  # [s] of the reference, at which the clock changes
TRACK = ('track:=circle', 'speed:=0.15', 'controller:=analytical', 'require_recorder:=false')
SHIFTS = (0.02, 0.05, 0.1, 0.15, 0.3, 1.0, 60.0, 3600.0)
FOLLOWING = (ControllerState.TRACKING, ControllerState.RECONTACT)
ENDED = (ControllerState.DONE, ControllerState.STOPPED, ControllerState.FAULT)
NAMED = ('clock', 'stamp', 'lockstep', 'simulated')
"""One of these words is in a cause that helps."""
Clock = Callable[[int], int]
"""The stamp [ns] of a wrong clock, from the right one [ns]."""
EPILOG = """
Example: scripts/in_env python tests/tools/cells/wrong_clocks.py --only lockstep
"""


@dataclass(frozen=True)
class ClockCase:
    """One run with a wrong clock.

    Attributes:
        name: for people.
        modes: of plant and controller.
        clock: of the cameras.
        from_start: whether it is wrong before the start; else from MOMENT on.
        laps: of the circle.
    """

    name: str
    modes: tuple[str, str]
    clock: Clock
    from_start: bool = True
    laps: int = 1


def shifted(seconds: float) -> Clock:
    """A clock that is ahead; with 0 it is right."""
    if seconds == 0.0:
        return lambda stamp: stamp
    # one ns more: no stamp is that of another pose
    return lambda stamp: max(stamp + round(1e9 * seconds) + 1, 0)


def drifting(ppm: float) -> Clock:
    """A clock that runs fast, and is right at its first stamp."""
    first: list[int] = []

    def clock(stamp: int) -> int:
        first.append(stamp) if not first else None
        return stamp + round((stamp - first[0]) * 1e-6 * ppm)

    return clock


def all_cases() -> Iterator[ClockCase]:
    """In groups of equal modes and laps."""
    real, step = ('realtime', 'realtime'), ('lockstep', 'lockstep')
    for modes in (real, step):
        for size in SHIFTS:
            for shift in (size, -size):
                for early in (True, False):
                    when = 'before the start' if early else 'during the run'
                    name = f'{modes[0]}, {shift:+g} s {when}'
                    yield ClockCase(name, modes, shifted(shift), early)
    for modes in (('lockstep', 'realtime'), ('realtime', 'lockstep')):
        yield ClockCase(f'plant in {modes[0]}, controller in {modes[1]}', modes, shifted(0.0))
    for modes in (real, step):
        for ppm in (1000.0, -1000.0):
            yield ClockCase(f'{modes[0]}, drift {ppm:+g} ppm', modes, drifting(ppm), laps=10)


class ClockBed:
    """A cell whose poses pass a relay that has a clock of its own."""

    def __init__(self, case: ClockCase, environment: dict[str, str], folder: Path) -> None:
        """Starts the nodes for a case, and for others of the same modes and laps."""
        self._graph = GraphByHand(environment, folder)
        self._relay = Relay(self._graph.node, connected=True)
        self._right: dict[int, int] = {}
        self._truth: dict[int, np.ndarray] = {}
        self._plan: NominalTrajectory | None = None
        self._clock: Clock = shifted(0.0)
        self._relay.spoil = self._stamp
        deep = QoSProfile(depth=5000)
        interface.GROUND_TRUTH.subscription(self._graph.node, self._on_truth, qos=deep)
        interface.NOMINAL_TRAJECTORY.subscription(self._graph.node, self._on_plan)
        self._graph.start('sim_node', f'mode:={case.modes[0]}', remapped=remappings())
        self._graph.start('gp_server', 'model:=analytical')
        self._graph.start('mpc_node', f'mode:={case.modes[1]}', f'laps:={case.laps}', *TRACK)

    def close(self) -> None:
        """Ends the nodes.

        Raises:
            RunError: one does not end at once when it is asked to.
        """
        try:
            for name in ('mpc_node', 'sim_node', 'gp_server'):
                if self._graph.end(name) not in (0, 130):
                    raise RunError(f'{name} did not end cleanly')
        finally:
            self._graph.close()

    def fault(self, case: ClockCase) -> tuple[str, str]:
        """What happened in a run, and what should not have."""
        self._clock = shifted(0.0)
        self._right.clear()
        self._truth.clear()
        self._graph.states.clear()
        answer = self._begin(case)
        if answer:
            return f'refused: {answer}', _unnamed(answer)
        graph = self._graph
        if not case.from_start:
            graph.happens(lambda: graph.reference_time > MOMENT or self._ended(), LONGEST_RUN)
            self._clock = case.clock
        if not graph.happens(self._ended, LONGEST_RUN):
            return 'does not end', 'it hangs'
        return self._judged(graph.states[-1])

    def _begin(self, case: ClockCase) -> str:
        """Starts; why not, if it is refused."""
        for service in (interface.STOP, interface.RESUME):
            self._graph.call_until_success(service)
        if case.from_start:
            self._clock = case.clock
        message, refused = '', 0
        for _ in range(ATTEMPTS):
            self._graph.call(interface.RESET_TO_PLAN)
            self._graph.happens(lambda: False, 0.1)
            self._graph.states.clear()
            answer = self._graph.call(interface.START)
            if answer is None:
                return 'no answer'
            if answer.success:
                return ''
            message = str(answer.message)
            refused = 0 if _unnamed(message) else refused + 1
            if refused == REFUSED:
                break
            self._graph.call(interface.RESUME)
        return message

    def _ended(self) -> bool:
        return self._graph.mode in ENDED

    def _judged(self, last: ControllerState) -> tuple[str, str]:
        worst = self._worst_error()
        what = f'largest error {1e3 * worst:.1f} mm'
        if last.mode != ControllerState.DONE:
            return f'{what}, stopped: {last.stop_reason}', _unnamed(last.stop_reason)
        return what, 'it is not where it should be' if worst > LARGEST_ERROR else ''

    def _worst_error(self) -> float:
        """Largest distance [m] of the true object from the plan in a tick that follows it."""
        plan = self._plan
        assert plan is not None
        errors = [0.0]
        for state in self._graph.states:
            right = self._right.get(to_nanoseconds(state.header.stamp), -1)
            true = self._truth.get(right)
            if state.mode in FOLLOWING and state.reference_time > 0.0 and true is not None:
                target = [
                    np.interp(state.reference_time, plan.time, axis) for axis in (plan.x, plan.y)
                ]
                errors.append(float(np.hypot(*(true - target))))
        return max(errors)

    def _stamp(self, message: Any, _topic: str) -> bool:
        right = to_nanoseconds(message.header.stamp)
        wrong = self._clock(right)
        self._right[wrong] = right
        message.header.stamp = to_stamp(wrong)
        return True

    def _on_truth(self, message: GroundTruth) -> None:
        pose = np.array(message.pose)
        self._truth[to_nanoseconds(message.header.stamp)] = pose[:2]

    def _on_plan(self, plan: NominalTrajectory) -> None:
        self._plan = plan


def _unnamed(reason: str) -> str:
    """A fault if a reason is not one line about clocks."""
    named = any(word in reason for word in NAMED) and '\n' not in reason
    return '' if named else 'the cause is not named'


def faults_of(
    cases: Sequence[ClockCase], environment: dict[str, str], folder: Path
) -> Iterator[tuple[ClockCase, str, str]]:
    """Runs cases of equal modes and laps; what happened in each, and what should not have."""
    bed = ClockBed(cases[0], environment, folder)
    try:
        for case in cases:
            yield case, *bed.fault(case)
    finally:
        bed.close()


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the cases; exit status 1 if something does not hold in one of them."""
    parser = Parser('Runs cells with wrong clocks.', epilog=EPILOG)
    parser.add_argument('--only', default='', help='cases whose name holds this text')
    return run_command(parser, _work, argv)


def _work(arguments: argparse.Namespace) -> None:
    domain = int(os.environ.get('ROS_DOMAIN_ID') or 0)
    chosen = [case for case in all_cases() if arguments.only in case.name]
    groups = {(case.modes, case.laps): [] for case in chosen}
    for case in chosen:
        groups[case.modes, case.laps].append(case)
    failed = 0
    for number, group in enumerate(groups.values()):
        # the relay of the last group is still known in its domain
        environment = {**os.environ, 'ROS_DOMAIN_ID': str(domain + number)}
        with tempfile.TemporaryDirectory(prefix='push_clocks_') as folder:
            for case, what, fault in faults_of(group, environment, Path(folder)):
                failed += bool(fault)
                sys.stdout.write(f'{case.name}: {what}{f" - {fault.upper()}" if fault else ""}\n')
                sys.stdout.flush()
    if failed:
        raise RunError(f'{failed} of {len(chosen)} cases')


if __name__ == '__main__':
    sys.exit(main())
