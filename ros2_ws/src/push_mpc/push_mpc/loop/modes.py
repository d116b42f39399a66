"""The modes of the controller, and the one table of transitions between them."""

from collections.abc import Mapping
from enum import Enum, IntEnum


class Mode(IntEnum):
    """Mode of the controller; the values are those of push_msgs/ControllerState."""

    IDLE = 0
    ARMED = 1
    TRACKING = 2
    DONE = 3
    STOPPED = 4
    HOLDING = 5
    RECONTACT = 6
    STOPPING = 7
    FAULT = 8


class Event(Enum):
    """What changes the mode; the values are the labels of the picture in docs/operating.md."""

    START = 'start'
    READY = 'enough good poses'
    APART = 'tip off the face'
    TOUCH = 'tip on the face'
    LATE = 'no fresh pose'
    POSE = 'fresh pose'
    END = 'end of the reference'
    STOP = 'stop'
    FAIL = 'fault'
    ENDED = 'at rest after the end'
    STOPPED = 'at rest after a stop'
    FAILED = 'at rest after a fault'
    RESUME = 'resume'


FOLLOWING = (Mode.TRACKING, Mode.RECONTACT)
"""Modes in which the reference runs."""

MOVING = (Mode.ARMED, *FOLLOWING, Mode.HOLDING)
"""Modes of a run, from its start to its end or stop."""

_ROWS: tuple[tuple[tuple[Mode, ...], Event, Mode], ...] = (
    ((Mode.IDLE, Mode.DONE), Event.START, Mode.ARMED),
    ((Mode.ARMED,), Event.READY, Mode.TRACKING),
    ((Mode.TRACKING,), Event.APART, Mode.RECONTACT),
    ((Mode.RECONTACT,), Event.TOUCH, Mode.TRACKING),
    (FOLLOWING, Event.LATE, Mode.HOLDING),
    ((Mode.HOLDING,), Event.POSE, Mode.TRACKING),
    (FOLLOWING, Event.END, Mode.STOPPING),
    ((*MOVING, Mode.IDLE, Mode.DONE, Mode.STOPPING), Event.STOP, Mode.STOPPING),
    ((*MOVING, Mode.IDLE, Mode.STOPPING), Event.FAIL, Mode.STOPPING),
    ((Mode.STOPPING,), Event.ENDED, Mode.DONE),
    ((Mode.STOPPING,), Event.STOPPED, Mode.STOPPED),
    ((Mode.STOPPING,), Event.FAILED, Mode.FAULT),
    ((Mode.STOPPED, Mode.FAULT), Event.RESUME, Mode.IDLE),
)

TRANSITIONS: Mapping[tuple[Mode, Event], Mode] = {
    (source, event): target for sources, event, target in _ROWS for source in sources
}
"""Mode and event to the next mode. Any other event leaves the mode as it is: a stop latches."""

_AT_REST = {
    Event.END: Event.ENDED,
    Event.STOP: Event.STOPPED,
    Event.FAIL: Event.FAILED,
}


class ModeMachine:
    """The mode, and why the run stopped.

    Attributes:
        mode: now.
        reason: of the first stop or fault since the last start or release; empty without one.
    """

    def __init__(self) -> None:
        self.mode = Mode.IDLE
        self.reason = ''
        self._at_rest = Event.ENDED

    def take(self, event: Event, reason: str = '') -> bool:
        """Takes an event; returns whether the table has a transition for it in this mode."""
        target = TRANSITIONS.get((self.mode, event))
        if target is None:
            return False
        if event in _AT_REST and not self.reason:
            self.reason, self._at_rest = reason, _AT_REST[event]
        elif target in (Mode.IDLE, Mode.ARMED):
            self.reason = ''
        self.mode = target
        return True

    def come_to_rest(self) -> None:
        """Ends STOPPING, when the command is zero."""
        self.take(self._at_rest)


def state_diagram() -> str:
    """The table as a Mermaid state diagram, one line for each transition."""
    lines = [
        f'{source.name} --> {target.name}: {event.value}'
        for (source, event), target in TRANSITIONS.items()
        if source != target
    ]
    return '\n'.join(['stateDiagram-v2', '[*] --> IDLE', *lines])
