"""The plant as a ROS node, in real time or in lockstep."""
