"""A fault, one case of it, and the verdict on that case."""

import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any


class Outcome(Enum):
    """What a fault must lead to."""

    CONTINUES = 'goes on'
    STOPS = 'stops with a reason'
    RESTS = 'rests'
    REFUSES = 'does not start'


@dataclass(frozen=True)
class Fault:
    """A kind of fault.

    Attributes:
        text: what happens, for people.
        outcome: what it must lead to.
        inject: puts the fault into a cell, a `Bed`; returns how long it lasts [s].
        reason: part of the reason that the operator must read, empty if none.
        detection: time [s] from its beginning until it can be known.
        modes: of the cell in which it can happen.
        parameters: of the cell, by NAME or NODE.NAME.
        sick: nodes of the cell that are replaced by ones that can be made sick.
        far: nodes of the cell that run in a network namespace of their own.
        breaks: whether the nodes cannot be used again afterwards.
        unrecorded: whether the bag cannot hold the reason.
    """

    text: str
    outcome: Outcome
    inject: Callable[[Any, random.Random], float]
    reason: str = ''
    detection: float = 0.0
    modes: tuple[str, ...] = ('realtime',)
    parameters: Mapping[str, object] = field(default_factory=dict)
    sick: tuple[str, ...] = ()
    far: tuple[str, ...] = ()
    breaks: bool = False
    unrecorded: bool = False


@dataclass(frozen=True)
class Case:
    """A fault in a cell of one mode, with a seed for the moment and all that is random."""

    kind: str
    fault: Fault
    mode: str
    seed: int

    @property
    def cell(self) -> tuple[object, ...]:
        """What the nodes must be like; cases that are equal in this can share them."""
        return (
            self.mode,
            self.fault.sick,
            self.fault.far,
            tuple(sorted(self.fault.parameters.items())),
        )


@dataclass(frozen=True)
class Verdict:
    """What a case led to.

    Attributes:
        case: that was run.
        moment: of the reference at which the fault began [s].
        rest: time [s] from the fault until the tip was at rest for good; NaN if it was not.
        fastest: largest speed of the tip [m/s].
        reason: that the controller or the cell gave.
        problems: what was not as it must be; empty if all was.
        attempts: how often it was run, because the host took the cores away.
        host_gap: largest time [s] in which the observer itself did not run.
    """

    case: Case
    moment: float
    rest: float
    fastest: float
    reason: str
    problems: tuple[str, ...]
    attempts: int = 1
    host_gap: float = 0.0

    def as_json(self) -> dict[str, object]:
        """The row of the table."""
        return {
            'fault': self.case.kind,
            'mode': self.case.mode,
            'seed': self.case.seed,
            'moment_s': self.moment,
            'expected': self.case.fault.outcome.value,
            'rest_s': self.rest,
            'fastest_m_s': self.fastest,
            'reason': self.reason,
            'problems': list(self.problems),
            'attempts': self.attempts,
        }
