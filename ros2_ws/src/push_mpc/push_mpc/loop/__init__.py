"""The 10 ms loop: one call per tick, without ROS."""
