"""The controller as a ROS node: topics, services, model client."""
