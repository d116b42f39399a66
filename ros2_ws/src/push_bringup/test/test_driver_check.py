"""The contract of docs/robot.md on synthetic messages: each fault is found, by its own point."""

import numpy as np
import pytest
from push_bringup.driver_check.contract import motion_points, pair_point, pose_points
from push_bringup.driver_check.heard_poses import HeardPoses, TipMotion
from push_mpc.settings.node_settings import MpcSettings

NOW = 1_700_000_000_000_000_000
SETTINGS = MpcSettings()
VELOCITY = np.array([0.0, 0.02])


def heard(seconds=3.0, *, topic='object_pose', rate=100.0, age=0.006, place=(0.1, 0.0), **changed):
    """Poses of a sound driver, but for what is changed."""
    stamp = NOW + (1e9 / rate * np.arange(round(seconds * rate))).astype(np.int64)
    values = {
        'stamp': stamp,
        'arrival': stamp + round(1e9 * age),
        'position': np.tile([*place, 0.0], (len(stamp), 1)),
        'quaternion': np.tile([0.0, 0.0, 0.0, 1.0], (len(stamp), 1)),
        'frames': ['world'] * len(stamp),
    }
    return HeardPoses(topic, **{**values, **changed})


def broken(points):
    return [point.name for point in points if not point.kept]


def test_a_sound_driver_keeps_every_point() -> None:
    poses = heard()
    assert broken([*pose_points(poses, SETTINGS), pair_point(poses, heard(), SETTINGS)]) == []


def test_a_tip_may_be_measured_more_often() -> None:
    assert broken(pose_points(heard(topic='pusher_pose', rate=250.0), SETTINGS)) == []
    assert broken(pose_points(heard(rate=250.0), SETTINGS)) == ['object_pose rate']


@pytest.mark.parametrize(
    ('poses', 'point'),
    [
        (heard(0.05), 'object_pose arrives'),
        (heard(rate=8.0), 'object_pose rate'),
        (heard(stamp=np.repeat(heard().stamp[::2], 2)), 'object_pose stamps'),
        (heard(frames=['map'] * 300), 'object_pose frame, units, age'),
        (heard(place=(100.0, 0.0)), 'object_pose frame, units, age'),
        (heard(age=-0.02), 'object_pose frame, units, age'),
        (heard(age=0.4), 'object_pose frame, units, age'),
        (heard(quaternion=np.zeros((300, 4))), 'object_pose frame, units, age'),
    ],
)
def test_each_fault_has_its_point(poses: HeardPoses, point: str) -> None:
    assert point in broken(pose_points(poses, SETTINGS))


def test_poses_that_arrive_in_bursts_have_gaps() -> None:
    stamp = heard().stamp
    bursts = np.repeat(stamp[9::10], 10) + np.tile(np.arange(10), 30)
    assert broken(pose_points(heard(arrival=stamp + 6_000_000), SETTINGS)) == []
    assert 'object_pose gaps' in broken(pose_points(heard(arrival=bursts), SETTINGS))


def test_poses_without_partners_do_not_pair() -> None:
    late = heard()
    shifted = heard(stamp=late.stamp + 4_000_000)
    far = heard(stamp=late.stamp[::4], arrival=late.stamp[::4])
    assert not pair_point(late, far, SETTINGS).kept
    assert pair_point(late, shifted, SETTINGS).kept


def driven(response) -> TipMotion:
    """A motion of which `response` gives the tip's velocity from the time [s] of each phase."""
    times = np.arange(0.0, 4.1, 0.01)
    velocity = np.array([response(time - 0.5) for time in times])
    place = np.cumsum(velocity, axis=0) * 0.01
    stamp = NOW + (1e9 * times).astype(np.int64)
    position = np.column_stack((place, np.zeros(len(times))))
    tip = heard(4.1, topic='pusher_pose', stamp=stamp, position=position)
    start, stopped, back, silent, end = (NOW + round(1e9 * t) for t in (0.5, 1.5, 2.3, 3.3, 4.1))
    return TipMotion(VELOCITY, 1.0, start, stopped, back, silent, end, tip)


def sound(time: float, delay: float = 0.1):
    """The commanded velocity, later."""
    then = time - delay
    if 0.0 <= then < 1.0:
        return VELOCITY
    return -VELOCITY if 1.8 <= then < 2.8 else 0.0 * VELOCITY


def test_a_sound_motion_keeps_every_point_and_shows_its_delay() -> None:
    points = list(motion_points(driven(sound)))
    assert broken(points) == []
    (delay,) = (point.text for point in points if point.name == 'delay')
    assert 90.0 <= float(delay.split()[1]) <= 110.0


def test_a_driver_that_ignores_commands_or_swaps_axes_is_found() -> None:
    assert 'moves as commanded' in broken(motion_points(driven(lambda time: 0.0 * VELOCITY)))
    assert 'moves as commanded' in broken(motion_points(driven(lambda t: sound(t)[::-1])))
    assert 'moves as commanded' in broken(motion_points(driven(lambda t: 1000 * sound(t))))


def test_a_driver_without_a_watchdog_is_found() -> None:
    points = motion_points(driven(lambda t: -VELOCITY if t > 1.9 else sound(t)))
    assert broken(points) == ['stops without commands', 'stops in time']


def test_a_late_driver_is_found() -> None:
    assert 'delay' in broken(motion_points(driven(lambda t: sound(t, 0.4))))
