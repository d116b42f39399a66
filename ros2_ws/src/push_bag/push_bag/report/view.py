"""A run as the report draws it: its series, its errors, its name and its colour."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from push_core.common import InputError
from push_report.figure_style import RUN_COLOURS

from push_bag.run import Reference, RunSeries
from push_bag.score import Contact, Timing, Tracking, contact, timing, track

Scored = tuple[RunSeries, Mapping[str, Any]]


@dataclass(frozen=True)
class View:
    """One run, ready to be drawn.

    Attributes:
        name: tells the runs of one report apart.
        colour: of its lines where several runs share a figure.
        run: what was recorded.
        score: of the run.
        reference: that it followed.
        tracking: its errors.
        contact: where the tip was on the face.
        timing: how long its loop took.
    """

    name: str
    colour: str
    run: RunSeries
    score: Mapping[str, Any]
    reference: Reference
    tracking: Tracking
    contact: Contact
    timing: Timing


def views(scored: Sequence[Scored]) -> list[View]:
    """The runs of one report, in the order given.

    Raises:
        InputError: a run holds no reference.
    """
    return [_view(number, run, score) for number, (run, score) in enumerate(scored)]


def title(score: Mapping[str, Any]) -> str:
    """What a run was, in a few words."""
    return f'{score["track"]} at {score["speed_m_s"] * 1e3:.0f} mm/s, {score["controller"]}'


def _view(number: int, run: RunSeries, score: Mapping[str, Any]) -> View:
    if run.reference is None:
        raise InputError('the bag holds no nominal trajectory, so there is nothing to report')
    return View(
        name=f'{number + 1}: {title(score)}{_setting(run)}',
        colour=RUN_COLOURS[number % len(RUN_COLOURS)],
        run=run,
        score=score,
        reference=run.reference,
        tracking=track(run, run.reference),
        contact=contact(run, run.reference),
        timing=timing(run),
    )


def _setting(run: RunSeries) -> str:
    """What else tells a run from others of its kind."""
    perturbed = run.facts.get('perturb', 'none')
    words = [] if perturbed == 'none' else [perturbed]
    words += [f'{name} {run.facts[name]}' for name in ('profile', 'seed') if name in run.facts]
    return f' ({", ".join(words)})' if words else ''
