"""The plant: world, robot driver, cameras and perturbations, one period at a time."""
