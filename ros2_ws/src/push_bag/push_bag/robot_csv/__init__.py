"""Measured runs of the real cell as bags."""

from push_bag.robot_csv.contact_check import check_contact
from push_bag.robot_csv.lost_rows import lost_rows
from push_bag.robot_csv.reference_line import reference_line
from push_bag.robot_csv.robot_run_messages import messages, topics

__all__ = ['check_contact', 'lost_rows', 'messages', 'reference_line', 'topics']
