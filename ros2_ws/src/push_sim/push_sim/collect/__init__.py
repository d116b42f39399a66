"""Short pushes made in a world, as training data."""
