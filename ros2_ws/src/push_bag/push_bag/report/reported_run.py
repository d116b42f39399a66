"""A run with all that the report draws of it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from push_core.common import InputError
from push_report.figure_style import RUN_COLOURS

from push_bag.run import Reference, RunSeries
from push_bag.score import (
    Contact,
    LoopTiming,
    Tracking,
    changes_in_words,
    contact,
    timing,
    tracking_errors,
)

Scored = tuple[RunSeries, Mapping[str, Any]]


@dataclass(frozen=True)
class ReportedRun:
    """One run of a report.

    Attributes:
        name: unique in the report.
        colour: of the run's lines in figures of several runs.
        series: the recorded time series.
        score: as `score_series` returns it.
        reference: the reference that the run followed.
        tracking: tracking errors.
        contact: position of the tip on the face.
        timing: times of the control loop.
    """

    name: str
    colour: str
    series: RunSeries
    score: Mapping[str, Any]
    reference: Reference
    tracking: Tracking
    contact: Contact
    timing: LoopTiming


def reported_runs(scored: Sequence[Scored]) -> list[ReportedRun]:
    """The runs of one report, in the order given.

    Raises:
        InputError: a run holds no reference.
    """
    return [_reported(number, run, score) for number, (run, score) in enumerate(scored)]


def title(score: Mapping[str, Any]) -> str:
    """Track, speed and controller of a run."""
    return f'{score["track"]} at {score["speed_m_s"] * 1e3:.4g} mm/s, {score["controller"]}'


def _reported(number: int, run: RunSeries, score: Mapping[str, Any]) -> ReportedRun:
    if run.reference is None:
        raise InputError('the bag holds no nominal trajectory, so there is nothing to report')
    return ReportedRun(
        name=f'{number + 1}: {title(score)}{_setting(run)}',
        colour=RUN_COLOURS[number % len(RUN_COLOURS)],
        series=run,
        score=score,
        reference=run.reference,
        tracking=tracking_errors(run, run.reference),
        contact=contact(run, run.reference),
        timing=timing(run),
    )


def _setting(run: RunSeries) -> str:
    """Perturbation, profile, seed and changed parameters of a run, in parentheses."""
    perturbed = run.facts.get('perturb', 'none')
    words = [] if perturbed == 'none' else [perturbed]
    words += [f'{name} {run.facts[name]}' for name in ('profile', 'seed') if name in run.facts]
    words += changes_in_words(run.facts.get('changed'))
    return f' ({", ".join(words)})' if words else ''
