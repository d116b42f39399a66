"""Measured runs of the real cell as bags."""

from push_bag.robot_csv.robot_run_messages import messages, topics

__all__ = ['messages', 'topics']
