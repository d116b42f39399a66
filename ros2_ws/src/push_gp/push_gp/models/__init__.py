"""Models of a push: the interface, the motion cone, the Gaussian processes, and their files."""
