"""The model server: answers queries for means, variances and Jacobians over ROS."""
