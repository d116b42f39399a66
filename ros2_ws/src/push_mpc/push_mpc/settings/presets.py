"""Bundles of the controller's defaults.

`tuned`: the defaults of the settings. `paper`: the weights, step and horizon of Bauza, Hogan and
Rodriguez 2018 without later additions, and the sign in their published linear models without which
so short a horizon does not work; docs/control.md states its errors. `relinearised`: the QP
of the controller `gp` along the last solution, with the weights that go with it.
"""

from dataclasses import replace
from typing import TypeVar

from push_core.common import replaced

from push_mpc.settings.controller_settings import ControllerSettings, ForceWeights, Weights

PRESETS = ('tuned', 'paper', 'relinearised')

S = TypeVar('S', bound=ControllerSettings)

_PAPER_WEIGHTS = Weights(
    position_x=6000.0,
    position_y=3000.0,
    heading=10.0,
    contact=3000.0,
    normal=10.0,
    tangential=0.001,
    change=0.0,
    smoothness=0.0,
)
_PAPER_FORCE_WEIGHTS = ForceWeights(
    position_x=6000.0,
    position_y=3000.0,
    heading=10.0,
    contact=0.0,
    normal=0.1,
    tangential=0.001,
    slip=0.001,
    change=0.0,
)
_PAPER = {
    'horizon_steps': 35,
    'horizon_step': 0.01,
    'relinearise': False,
    'sideways_response': -1.0,
    'consistent_plan': False,
    'disturbance_length': 0.0,
}


_RELINEARISED = {'relinearise': True, 'disturbance_length': 0.035}


def with_preset(settings: S, preset: str) -> S:
    """The settings with the values of a preset; validation names an unknown one."""
    if preset == 'relinearised':
        weights = replace(settings.weights, change=6.0, smoothness=2.0)
        return replaced(replace(settings, weights=weights), _RELINEARISED)
    if preset != 'paper':
        return settings
    weighted = replace(settings, weights=_PAPER_WEIGHTS, force_weights=_PAPER_FORCE_WEIGHTS)
    return replaced(weighted, _PAPER)
