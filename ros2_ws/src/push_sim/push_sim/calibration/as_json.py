"""A calibration as figures: the JSON of `calibrate`."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from push_sim.calibration.fit import Calibration
from push_sim.validation import as_json as validation_json


@dataclass(frozen=True)
class Bar:
    """A figure that the plant has to hold.

    Attributes:
        name: of the figure.
        limit: largest value that is good enough.
        fitted: its value on the part that was fitted; None without such measurements.
        kept: its value on the rest.
    """

    name: str
    limit: float
    fitted: float | None
    kept: float | None


def calibration_json(found: Calibration, seed: int, measured: str) -> dict[str, Any]:
    """The whole object.

    Args:
        found: by the calibration.
        seed: of split and bootstrap.
        measured: SHA-256 of the measurements.
    """
    fitted, kept = validation_json(found.fitted), validation_json(found.kept)
    return {
        'seed': seed,
        'data_sha256': measured,
        'parameters': {
            each.name: {
                'value': each.value,
                'deviation': each.deviation,
                'unit': each.unit,
                'before': each.before,
            }
            for each in found.parameters
        },
        'stiffness': _stiffness(found),
        'bars': [vars(bar) for bar in bars(fitted, kept)],
        'fitted': fitted,
        'kept': kept,
    }


def bars(fitted: dict[str, Any], kept: dict[str, Any]) -> Iterator[Bar]:
    """The figures that count, on both parts, the worst of the files where there are several."""
    parts = fitted, kept
    yield Bar('4 mm pushes, mean NMSE in the push frame', 0.070, *map(_short, parts))
    yield Bar('50 mm pushes on the face [mm]', 3.8, *(_long(part, 'mean_mm') for part in parts))
    yield Bar('50 mm pushes on the face [deg]', 4.3, *(_long(part, 'mean_deg') for part in parts))


def _short(figures: dict[str, Any]) -> float | None:
    short = figures['pushes_4mm']
    return short['nmse_push_frame']['mean'] if short else None


def _long(figures: dict[str, Any], name: str) -> float | None:
    values = [each['on_face'][name] for each in figures['pushes_50mm']]
    return max((value for value in values if value is not None), default=None)


def _stiffness(found: Calibration) -> dict[str, Any] | None:
    """What the pushes say about the stiffness of the feet, which stays as it is."""
    if found.world is None:
        return None
    return {
        'value': found.settings.world.stiffness,
        'effect_on_misfit': found.world.stiffness_effect,
        'misfit': found.world.misfit,
        'misfit_deviation': found.world.misfit_deviation,
        'carried': found.world.stiffness_effect > found.world.misfit_deviation,
    }
