"""A calibration as a table for people."""

from collections.abc import Iterator, Mapping
from typing import Any


def calibration_table(figures: Mapping[str, Any]) -> str:
    """The figures of `calibration_json` as text."""
    lines = [
        f'{"parameter":30}{"found":>10}{"deviation":>12}{"before":>10}',
        *(_parameter(name, each) for name, each in figures['parameters'].items()),
        *_stiffness(figures['stiffness']),
        '',
        f'{"":44}{"fitted part":>12}{"the rest":>10}{"at most":>10}',
        *map(_bar, figures['bars']),
        '',
        'tip of the run that was fitted and of the others, rms a coordinate [mm]',
        *(_run(each) for part in ('fitted', 'kept') for each in figures[part]['robot_runs']),
    ]
    return '\n'.join(lines) + '\n'


def _parameter(name: str, each: Mapping[str, Any]) -> str:
    found, deviation, before = each['value'], each['deviation'], each['before']
    return f'{name:30}{found:10.5f}{deviation:12.2g}{before:10.5f} {each["unit"]}'.rstrip()


def _stiffness(stiffness: Mapping[str, Any] | None) -> Iterator[str]:
    if stiffness is None:
        return
    carried = 'tell it' if stiffness['carried'] else 'do not tell it'
    yield (
        f'world.stiffness stays {stiffness["value"]:g} N/m: the pushes {carried}; three times as '
        f'much or as little\n  changes the misfit of {stiffness["misfit"]:.4f} by '
        f'{stiffness["effect_on_misfit"]:.4f}, other pushes by {stiffness["misfit_deviation"]:.4f}'
    )


def _bar(bar: Mapping[str, Any]) -> str:
    values = ''.join(
        _cell(value, width) for value, width in ((bar['fitted'], 12), (bar['kept'], 10))
    )
    return f'{bar["name"]:44}{values}{bar["limit"]:10.3f}'


def _run(run: Mapping[str, Any]) -> str:
    return f'  {run["file"]:42}{run["tip_rms_mm"]:12.3f}'


def _cell(value: float | None, width: int) -> str:
    return f'{"-":>{width}}' if value is None else f'{value:{width}.3f}'
