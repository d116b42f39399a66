"""Bundles of the controller's defaults.

`tuned`: the defaults of the settings. `paper`: the weights, step and horizon of Bauza, Hogan and
Rodriguez 2018 without later additions; docs/control.md states its errors.
"""

from dataclasses import replace
from typing import TypeVar

from push_core.common import replaced

from push_mpc.settings.controller_settings import ControllerSettings, ForceWeights, Weights

PRESETS = ('tuned', 'paper')

S = TypeVar('S', bound=ControllerSettings)

_PAPER_WEIGHTS = Weights(
    position_x=6000.0,
    position_y=3000.0,
    heading=10.0,
    contact=3000.0,
    normal=10.0,
    tangential=0.001,
    change=0.0,
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
    'consistent_plan': False,
    'disturbance_length': 0.0,
}


def with_preset(settings: S, preset: str) -> S:
    """The settings with the values of a preset; validation names an unknown one."""
    if preset != 'paper':
        return settings
    weighted = replace(settings, weights=_PAPER_WEIGHTS, force_weights=_PAPER_FORCE_WEIGHTS)
    return replaced(weighted, _PAPER)
