"""Output of `calibrate`: its JSON object, its table and its ROS parameter file."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from push_core.common import plain_table

from push_sim.calibration.calibration import FittedParameter, PlantCalibration
from push_sim.validation import validation_json

PARAMETER_HEAD = ('parameter', 'fitted', 'deviation', 'before', 'unit')
_REQUIREMENT_HEAD = ('required', 'fitted part', 'the rest', 'at most')
_RUN_HEAD = ('tip of the fitted run and of the others', 'rms of a coordinate [mm]')
_PARAMETER_KEYS = ('value', 'deviation', 'unit', 'before')
_NODE_PARAMETERS = {'sim_node': ('world', 'actuator'), 'mpc_node': ('actuator',)}
"""Parameter groups of each node; the controller predicts with the plant's actuator."""


def calibration_json(result: PlantCalibration, seed: int, data_hash: str) -> dict[str, Any]:
    """The JSON object.

    Args:
        result: of the calibration.
        seed: seed of the split and of the bootstrap.
        data_hash: SHA-256 of the measurements.
    """
    fitted, kept = validation_json(result.fitted), validation_json(result.kept)
    return {
        'seed': seed,
        'data_sha256': data_hash,
        'parameters': parameter_json(result.parameters),
        'stiffness': _stiffness_json(result),
        'bars': _requirements(fitted, kept),
        'fitted': fitted,
        'kept': kept,
    }


def parameter_json(parameters: Sequence[FittedParameter]) -> dict[str, Any]:
    """The fitted parameters by name."""
    return {
        each.name: {name: getattr(each, name) for name in _PARAMETER_KEYS} for each in parameters
    }


def _requirements(fitted: dict[str, Any], kept: dict[str, Any]) -> list[dict[str, Any]]:
    """The required figures with their values on both parts; None without measurements."""
    return [
        {'name': name, 'limit': limit, 'fitted': value(fitted), 'kept': value(kept)}
        for name, limit, value in (
            ('4 mm pushes, mean NMSE in the push frame', 0.070, _short_nmse),
            ('50 mm pushes on the face [mm]', 3.8, partial(_long_error, 'mean_mm')),
            ('50 mm pushes on the face [deg]', 4.3, partial(_long_error, 'mean_deg')),
        )
    ]


def _short_nmse(figures: dict[str, Any]) -> float | None:
    short = figures['pushes_4mm']
    return short['nmse_push_frame']['mean'] if short else None


def _long_error(name: str, figures: dict[str, Any]) -> float | None:
    """The largest error of all files."""
    values = [each['on_face'][name] for each in figures['pushes_50mm']]
    return max((value for value in values if value is not None), default=None)


def _stiffness_json(result: PlantCalibration) -> dict[str, Any] | None:
    """Sensitivity of the misfit to the stiffness of the feet, which is not fitted."""
    if result.world is None:
        return None
    return {
        'value': result.settings.world.stiffness,
        'effect_on_misfit': result.world.stiffness_effect,
        'misfit': result.world.misfit,
        'misfit_deviation': result.world.misfit_deviation,
        'carried': result.world.stiffness_effect > result.world.misfit_deviation,
    }


def calibration_table(figures: Mapping[str, Any]) -> str:
    """The figures of `calibration_json` as text."""
    runs = (each for part in ('fitted', 'kept') for each in figures[part]['robot_runs'])
    blocks = (
        [
            *plain_table([PARAMETER_HEAD, *map(parameter_row, figures['parameters'].items())]),
            *_stiffness_lines(figures['stiffness']),
        ],
        plain_table([_REQUIREMENT_HEAD, *map(_requirement_row, figures['bars'])]),
        plain_table([_RUN_HEAD, *((run['file'], f'{run["tip_rms_mm"]:.3f}') for run in runs)]),
    )
    return '\n'.join('\n'.join([*lines, '']) for lines in blocks)


def parameter_row(named: tuple[str, Mapping[str, Any]]) -> Sequence[str]:
    """The cells of one fitted parameter."""
    name, each = named
    value, deviation, before = each['value'], each['deviation'], each['before']
    return name, f'{value:.5f}', f'{deviation:.2g}', f'{before:.5f}', each['unit']


def _stiffness_lines(stiffness: Mapping[str, Any] | None) -> Iterator[str]:
    if stiffness is None:
        return
    verdict = 'identify' if stiffness['carried'] else 'do not identify'
    yield (
        f'world.stiffness stays {stiffness["value"]:g} N/m: the pushes {verdict} it; three times '
        f'as stiff or as soft\n  changes the misfit of {stiffness["misfit"]:.4f} by '
        f'{stiffness["effect_on_misfit"]:.4f}, its deviation over the choice of pushes is '
        f'{stiffness["misfit_deviation"]:.4f}'
    )


def _requirement_row(each: Mapping[str, Any]) -> Sequence[str]:
    values = (each[name] for name in ('fitted', 'kept', 'limit'))
    return each['name'], *('-' if value is None else f'{value:.3f}' for value in values)


def ros_parameter_file(parameters: Sequence[FittedParameter], data_hash: str) -> str:
    """Text of a parameter file for plant and controller.

    Args:
        parameters: fitted parameters.
        data_hash: SHA-256 of the measurements.
    """
    head = (
        '# Made by `ros2 run push_sim calibrate`; `cell --params FILE` uses it.\n'
        '# After each value: its standard deviation.\n'
        f'# measurements: SHA-256 {data_hash}\n'
    )
    blocks = (_node_block(node, groups, parameters) for node, groups in _NODE_PARAMETERS.items())
    return head + ''.join(blocks)


def _node_block(node: str, groups: Sequence[str], parameters: Sequence[FittedParameter]) -> str:
    own = [each for each in parameters if each.name.split('.')[0] in groups]
    if not own:
        return ''
    lines = ''.join(f'    {_parameter_line(each)}\n' for each in own)
    return f'/**/{node}:\n  ros__parameters:\n{lines}'


def _parameter_line(parameter: FittedParameter) -> str:
    value = f'{parameter.name}: {parameter.value:.6f}'
    return f'{value:34}# +- {parameter.deviation:.2g} {parameter.unit}'.rstrip()
