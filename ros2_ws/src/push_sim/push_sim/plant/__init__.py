"""The plant: world, robot driver, cameras and perturbations, one period at a time."""

from push_sim.plant.perturbation import Disturbance, Kind, Perturbation
from push_sim.plant.plant import Observation, Plant
from push_sim.plant.sensor import Sensor

__all__ = ['Disturbance', 'Kind', 'Observation', 'Perturbation', 'Plant', 'Sensor']
