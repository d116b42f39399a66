"""Plant and controller in one loop without ROS; also computes a recorded run again."""

from push_bringup.in_process.loop import InProcessCell
from push_bringup.in_process.recorded_model import recorded_lessons
from push_bringup.in_process.tables import tabulated

__all__ = ['InProcessCell', 'recorded_lessons', 'tabulated']
