"""The plant: world, robot driver, cameras and perturbations, one period at a time."""

from push_sim.plant.perturbation import AppliedPerturbation, Perturbation
from push_sim.plant.plant import Plant
from push_sim.plant.sensor import Observation, Sensor, TrueState
from push_sim.settings import PerturbationKind

__all__ = [
    'AppliedPerturbation',
    'Observation',
    'Perturbation',
    'PerturbationKind',
    'Plant',
    'Sensor',
    'TrueState',
]
