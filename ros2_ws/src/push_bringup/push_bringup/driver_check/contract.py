"""The points of docs/robot.md that messages can show; arrays in, findings out."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array
from push_mpc.estimate import PoseGate
from push_mpc.settings import MpcSettings
from push_node.interface import OBJECT_POSE

from push_bringup.driver_check.heard_poses import HeardPoses, TipMotion

PATIENCE = 0.01  # [s] that remains of pose_timeout after 95 % of the gaps between two poses
FASTEST = 1.1  # poses of the object in a period of the controller, which answers each of them
STILL = 1e-3  # [m] by which a tip at rest may move, with the noise of its measurement
DISTANCE_TOLERANCE = 0.15
LONGEST_DELAY = 0.3  # [s] from command to motion; the predictor reaches no further
BRAKING_TIME = 0.3  # [s] beyond the delay, for command_timeout and deceleration
_REST = 0.15  # [s] at the end of a phase, over which rest is judged


@dataclass(frozen=True)
class Point:
    """One point of the contract.

    Attributes:
        name: of the point.
        kept: None if it was not tested.
        text: what was seen.
    """

    name: str
    kept: bool | None
    text: str

    def __str__(self) -> str:
        word = {True: 'ok        ', False: 'FAILED    ', None: 'not tested'}[self.kept]
        return f'{word}  {self.name}: {self.text}'


def pose_points(poses: HeardPoses, settings: MpcSettings) -> Iterator[Point]:
    """What one pose topic keeps: rate, gaps, order of stamps, and the gate of the controller."""
    name = poses.topic
    if len(poses) < 10:
        yield Point(f'{name} arrives', False, f'{len(poses)} messages')
        return
    gaps = np.diff(poses.arrival) * 1e-9
    rate = 1e9 * (len(poses) - 1) / float(poses.stamp[-1] - poses.stamp[0] or 1)
    longest = settings.pose_timeout - PATIENCE
    # each pose of the object is answered, and finds its partner among the last ones of the tip
    low, high = 1.0 / longest, FASTEST / settings.period if name == OBJECT_POSE.name else np.inf
    text = f'{rate:.1f} Hz by its stamps, must be {low:.0f} to {high:.0f} Hz'
    yield Point(f'{name} rate', low < rate < high, text)
    usual = float(np.quantile(gaps, 0.95))
    text = (
        f'95 % within {1e3 * usual:.1f} of {1e3 * longest:.0f} ms, '
        f'longest {1e3 * gaps.max():.1f} ms'
    )
    yield Point(f'{name} gaps', usual <= longest, text)
    steps = np.diff(poses.stamp)
    backwards = int(np.count_nonzero(steps <= 0))
    yield Point(f'{name} stamps', not backwards, f'{backwards} of {len(steps)} do not increase')
    yield _gate_point(poses, settings)


def pair_point(object_poses: HeardPoses, tips: HeardPoses, settings: MpcSettings) -> Point:
    """Whether each pose of the object has one of the tip at its time."""
    name, tolerance = 'pairs of poses', settings.poses.pair_tolerance
    if not len(object_poses) or not len(tips):
        return Point(name, False, 'a topic is silent')
    inside = object_poses.stamp[
        (object_poses.stamp >= tips.stamp.min()) & (object_poses.stamp <= tips.stamp.max())
    ]
    apart = 1e-9 * np.abs(inside[:, None] - tips.stamp[None, :]).min(axis=1, initial=2**60)
    paired = float(np.mean(apart <= tolerance)) if len(inside) else 0.0
    text = f'{100 * paired:.0f} % of the stamps differ by at most {1e3 * tolerance:g} ms'
    return Point(name, paired > 0.9, text)


def motion_points(motion: TipMotion) -> Iterator[Point]:
    """Whether the tip moved as commanded, stopped, and stopped when commands ceased."""
    speed = float(np.hypot(*motion.velocity))
    way, wanted = motion.velocity / speed, speed * motion.duration
    moved = _way(motion, motion.start, motion.back)
    forth, across = float(moved @ way), float(moved @ [-way[1], way[0]])
    kept = abs(forth / wanted - 1.0) < DISTANCE_TOLERANCE and abs(across) < 0.1 * wanted + STILL
    text = f'{1e3 * forth:.1f} of {1e3 * wanted:.1f} mm, {1e3 * across:.1f} mm aside'
    yield Point('moves as commanded', kept, text)
    delay = _delay(motion, way, speed)
    text = f'moves {1e3 * delay:.0f} ms after the command (dead time + lag of mpc_node)'
    yield Point('delay', 0.0 < delay < LONGEST_DELAY, text)
    yield _rest_point('stops on a zero command', motion, motion.back)
    yield _rest_point('stops without commands', motion, motion.end)
    run_on = abs(float(_way(motion, motion.back, motion.end) @ way)) - wanted
    bound = speed * BRAKING_TIME + STILL
    text = f'{1e3 * run_on:.1f} mm further than commanded, at most {1e3 * bound:.1f} mm'
    yield Point('stops in time', run_on < bound, text)


def _gate_point(poses: HeardPoses, settings: MpcSettings) -> Point:
    """Runs the gate of the controller over the messages."""
    gate, reasons = PoseGate(settings.poses, settings.limits), Counter[str]()
    for frame, position, quaternion, age in zip(
        poses.frames, poses.position, poses.quaternion, poses.age, strict=True
    ):
        x, y, z = position
        rejection = gate.check(poses.topic, frame, (x, y, z), tuple(quaternion), float(age))
        if rejection:
            reasons[rejection.reason] += 1
    refused = sum(gate.counts.values())
    ages = f'stamps are {1e3 * poses.age.min():.1f} to {1e3 * poses.age.max():.1f} ms old'
    worst = f'; {refused} refused, as: {reasons.most_common(1)[0][0]}' if refused else ''
    # a busy listener sees old stamps of a sound driver
    sound = refused <= 0.02 * len(poses)
    return Point(f'{poses.topic} frame, units, age', sound, f'{ages}{worst}')


def _way(motion: TipMotion, start: int, end: int) -> Array:
    """Displacement (2,) of the tip between two times, each at rest."""
    before = motion.tip.between(start - _nanoseconds(_REST), start)
    after = motion.tip.between(end - _nanoseconds(_REST), end)
    if not len(before) or not len(after):
        return np.full(2, np.nan)
    return np.asarray(np.median(after, axis=0) - np.median(before, axis=0))


def _delay(motion: TipMotion, way: Array, speed: float) -> float:
    """Time [s] by which the motion lags behind the command while the speed is constant."""
    stamps = motion.tip.stamp
    late = (stamps > motion.stopped - _nanoseconds(0.5 * motion.duration)) & (
        stamps <= motion.stopped
    )
    rest = motion.tip.between(motion.start - _nanoseconds(_REST), motion.start)
    if not late.any() or not len(rest):
        return float('nan')
    travelled = (motion.tip.position[late, :2] - np.median(rest, axis=0)) @ way
    elapsed = 1e-9 * (stamps[late] - motion.start)
    return float(np.median(elapsed - travelled / speed))


def _rest_point(name: str, motion: TipMotion, end: int) -> Point:
    places = motion.tip.between(end - _nanoseconds(_REST), end)
    if not len(places):
        return Point(name, False, 'no pose of the tip')
    moved = float(np.hypot(*np.ptp(places, axis=0)))
    return Point(name, moved < STILL, f'moves {1e3 * moved:.2f} mm in the last {_REST:g} s')


def _nanoseconds(seconds: float) -> int:
    return round(1e9 * seconds)
