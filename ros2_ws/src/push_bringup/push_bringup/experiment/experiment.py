"""The paper's experiments, and what decides how a lap of one goes."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

from push_gp.models import ANALYTICAL

from push_bringup.setup import CellParameters, Request, code_key, installed_config, resolved


@dataclass(frozen=True)
class Experiment:
    """Track, speed [m/s] and perturbation."""

    track: str
    speed: float
    perturbation: str = 'none'


PAPER_MM = {
    Experiment('eight', 0.08): {'analytical': 9.56, 'gp': 8.50},
    Experiment('eight', 0.02): {'analytical': 2.89, 'gp': 6.53},
    Experiment('eight', 0.08, 'normal'): {'analytical': 11.10, 'gp': 8.52},
    Experiment('eight', 0.08, 'tangential'): {'analytical': 12.37, 'gp': 9.28},
    Experiment('square', 0.05): {'analytical': 4.95, 'gp': 6.60},
}
"""The rows of the paper's table with its mean errors on the real robot."""


@dataclass(frozen=True)
class LapJob:
    """One lap to be pushed.

    Attributes:
        experiment: what is pushed.
        controller: its name.
        model: path of the model file, or 'analytical'.
        profile: of the plant and of the robot that the controller assumes.
        seed: of everything random.
        overrides: further parameters, as `cell -p` takes them.
        laps: rounds of a closed track in one run.
        learn: whether each lap teaches the next.
    """

    experiment: Experiment
    controller: str
    model: str
    profile: str
    seed: int
    overrides: Mapping[str, object] = field(default_factory=dict)
    laps: int = 1
    learn: bool = False

    @cached_property
    def key(self) -> str:
        """Hash of everything that decides how the lap goes: code, model file, parameters.

        Raises:
            InputError: an override is unknown or out of range.
        """
        path = Path(self.model)
        model = path.read_bytes() if path.is_file() else self.model.encode()
        # where the model file lies does not matter
        values = replace(self, model=ANALYTICAL)
        parameters = values.parameters().as_yaml()
        parts = (code_key().encode(), model, repr(values).encode(), parameters.encode())
        return hashlib.sha256(
            b''.join(hashlib.sha256(part).digest() for part in parts)
        ).hexdigest()

    def parameters(self) -> CellParameters:
        """The parameters of every node.

        Raises:
            InputError: an override is unknown or out of range.
        """
        request = Request(
            track=self.experiment.track,
            speed=self.experiment.speed,
            controller=self.controller,
            model=self.model,
            profile=self.profile,
            perturb=self.experiment.perturbation,
            laps=self.laps,
            seed=self.seed,
            mode='inprocess',
            output=Path(),
            namespace='',
            overrides=dict(self.overrides),
        )
        return resolved(request, installed_config('cell.yaml'))
