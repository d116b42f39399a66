"""Settings of the controller and of its node."""
