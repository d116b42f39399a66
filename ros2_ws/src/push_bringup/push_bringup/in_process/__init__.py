"""Plant and controller in one loop without ROS; also computes a recorded run again."""
