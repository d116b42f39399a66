"""The model: Gaussian processes over contact point and push direction, and their server."""
