"""What a witness of random sequences takes for the same start, and for the same error."""

from dataclasses import replace

import pytest
from push_msgs.msg import ControllerState
from sequence_checks import SeenStart, of_bag, score_faults

TICKS = [(count, 10 * count, 0.3) for count in range(4)]
STOPPED = SeenStart(
    ticks={TICKS[0], TICKS[1]},
    rest=TICKS[2],
    outcome=ControllerState.STOPPED,
    last=ControllerState(),
)


def score(largest: float | None) -> dict[str, object]:
    return {'stop_reason': '', 'completed': False, 'tracking_error_mm': {'max': largest}}


def test_a_start_that_ends_before_its_reference_begins_has_no_error() -> None:
    assert [*score_faults(score(None), STOPPED)] == []
    assert 'None m away' in next(score_faults(score(0.7), STOPPED))


@pytest.mark.parametrize(('largest', 'agrees'), [(0.7, True), (1.4, False), (None, False)])
def test_a_start_that_moved_has_that_of_the_witness(largest, agrees) -> None:
    moved = replace(STOPPED, deviation=0.7e-3)
    assert (not [*score_faults(score(largest), moved)]) == agrees


def test_a_bag_that_begins_with_the_end_of_a_start_does_not_hold_the_start() -> None:
    assert [*of_bag({*TICKS[2:]}, [], [STOPPED])] == []
    assert [*of_bag({*TICKS[1:]}, [], [STOPPED])] == ['start 1 is scored 0 times']
