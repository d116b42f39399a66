"""The contract of a robot driver, checked on a driver that runs."""

from push_bringup.driver_check.contract import Point, motion_points, pair_point, pose_points
from push_bringup.driver_check.heard_poses import HeardPoses, TipMotion

__all__ = ['HeardPoses', 'Point', 'TipMotion', 'motion_points', 'pair_point', 'pose_points']
