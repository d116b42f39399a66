"""The model: pushes, Gaussian processes over contact point and push direction, and the server that answers for them."""
