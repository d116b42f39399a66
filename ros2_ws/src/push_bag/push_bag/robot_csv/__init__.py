"""Measured runs of the real cell as bags."""

from push_bag.robot_csv.robot_run import read_robot_run
from push_bag.robot_csv.robot_run_messages import messages, topics

__all__ = ['messages', 'read_robot_run', 'topics']
