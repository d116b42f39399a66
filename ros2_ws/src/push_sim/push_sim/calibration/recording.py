"""Calibrates the robot's response to a recorded run: dead time and lag of its tip."""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any

import numpy as np
from push_core.common import InputError, plain_table
from push_core.data import CommandedTip
from push_core.physics import ActuatorSettings

from push_sim.calibration.calibration import FittedParameter, actuator_parameters
from push_sim.calibration.output import PARAMETER_HEAD, parameter_json, parameter_row
from push_sim.fitting import fit_recorded
from push_sim.measured import recorded_tip_error, rms_coordinate

READERS = 'push_sim.commanded_tip'
"""Entry point of a function from the path of a bag to its `CommandedTip`."""
JUMP = 0.01  # [m] between two poses; a perturbation, not a motion of the robot
LEAST_WAY = 0.05  # [m]


@dataclass(frozen=True)
class RecordedCalibration:
    """The response of a recorded robot.

    Attributes:
        parameters: dead time and lag.
        before: root mean square of a coordinate of the error with the initial guess [m].
        after: the same with the fitted parameters [m].
    """

    parameters: tuple[FittedParameter, ...]
    before: float
    after: float

    def as_json(self, data_hash: str) -> dict[str, Any]:
        """The JSON object."""
        return {
            'data_sha256': data_hash,
            'parameters': parameter_json(self.parameters),
            'tip_rms_mm': {'before': 1e3 * self.before, 'fitted': 1e3 * self.after},
        }


def is_bag(path: Path) -> bool:
    """Whether a path is an MCAP file or a folder with one."""
    return path.suffix == '.mcap' or any(path.glob('*.mcap'))


def read_recording(path: Path) -> CommandedTip:
    """Commands and tip of the last start in a bag.

    Raises:
        InputError: it cannot be read, or nothing reads bags here.
    """
    readers = list(entry_points(group=READERS))
    if not readers:
        raise InputError('nothing reads bags here; build and source push_bag')
    read: Any = readers[0].load()
    recorded: CommandedTip = read(path)
    return recorded


def calibrate_recorded(
    recorded: CommandedTip, start: ActuatorSettings, seed: int
) -> RecordedCalibration:
    """Fits dead time and lag.

    Args:
        recorded: commands and tip.
        start: initial guess.
        seed: of the bootstrap.

    Raises:
        InputError: the tip moves too little to tell.
    """
    part = recorded.undisturbed(JUMP)
    way = float(np.hypot(*np.diff(part.tip[::10], axis=0).T).sum())
    if way < LEAST_WAY:
        raise InputError(
            f'{recorded.name}: the tip moves {1e3 * way:.0f} mm, too little to tell its lag; '
            f'at least {1e3 * LEAST_WAY:.0f} mm, with changes of the velocity'
        )
    fit = fit_recorded(part, start)
    return RecordedCalibration(
        tuple(actuator_parameters(fit, start, seed)),
        rms_coordinate(recorded_tip_error(part, start)),
        rms_coordinate(fit.residual),
    )


def recorded_table(figures: Mapping[str, Any]) -> str:
    """The figures of `RecordedCalibration.as_json` as text."""
    rows = map(parameter_row, figures['parameters'].items())
    rms = figures['tip_rms_mm']
    lines = [
        *plain_table([PARAMETER_HEAD, *rows]),
        f'tip: modelled minus measured {rms["fitted"]:.3f} mm rms of a coordinate, '
        f'{rms["before"]:.3f} mm before',
    ]
    return '\n'.join([*lines, ''])
