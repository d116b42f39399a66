"""Loss of contact, with the real plant where it matters."""

import math

import numpy as np
import pytest
from push_mpc.loop.controller import Mode
from push_mpc.settings.recontact import RecontactSettings, approach, departure, is_apart
from push_sim.settings.plant_settings import PerturbationKind

SETTINGS = RecontactSettings()


def distance_to_reference(cell, tick) -> float:
    wanted, _ = cell.controller.plan.at(tick.reference_time)
    return math.hypot(*(tick.state[:2] - wanted[:2]))


def test_off_the_face_it_approaches_and_then_catches_up_with_the_reference(tracking) -> None:
    tracking.disturb(PerturbationKind.NORMAL, 0.03)
    ticks = [tracking.tick() for _ in range(150)]
    modes = [tick.mode for tick in ticks]
    back = modes.index(Mode.TRACKING, modes.index(Mode.RECONTACT))
    assert Mode.RECONTACT in modes[:3]
    assert set(modes[back:]) == {Mode.TRACKING}
    assert back < 40
    fastest = max(math.hypot(*tick.velocity) for tick in ticks[:back])
    assert fastest <= SETTINGS.speed * (1 + 1e-9)
    assert distance_to_reference(tracking, ticks[2]) > 0.02
    assert distance_to_reference(tracking, ticks[-1]) < 5e-3


@pytest.mark.parametrize(
    ('along', 'aside', 'reason'),
    [
        (0.0, 0.06, 'beside the object'),
        (0.03, -0.06, 'beside the object'),
        (0.06, 0.0, 'behind the object'),
    ],
)
def test_a_pusher_that_left_the_face_for_good_stops_and_says_so(
    tracking, along, aside, reason
) -> None:
    pose = np.zeros(3)
    tip = np.array([along, aside])
    now, before = tracking.plant.time - tracking.plant.START, np.inf
    for later in np.arange(now, now + 0.05, 0.01):
        tick = tracking.controller.step(pose, tip, later - 0.005, later)
        assert np.hypot(*tick.velocity) < before
        before = np.hypot(*tick.velocity) or np.inf
    assert (tick.mode, np.any(tick.velocity)) == (Mode.STOPPED, False)
    assert reason in tracking.controller.stop_reason


def test_contact_is_lost_at_the_gap_and_regained_by_touching() -> None:
    assert not is_apart(SETTINGS, 0.0019, was_apart=False)
    assert is_apart(SETTINGS, 0.0021, was_apart=False)
    assert is_apart(SETTINGS, 0.0019, was_apart=True)
    assert not is_apart(SETTINGS, 0.0001, was_apart=True)


def test_a_tip_that_would_miss_the_face_goes_along_it_first(slider) -> None:
    v_n, v_t = approach(SETTINGS, slider, 0.02, 0.05, 0.0)
    assert v_n == 0.0
    assert -SETTINGS.speed <= v_t < 0.0
    v_n, v_t = approach(SETTINGS, slider, 0.02, -0.01, 0.0)
    assert v_n > 0.0 < v_t


def test_the_approach_slows_down_near_the_face_but_arrives(slider) -> None:
    far, near, touching = (
        approach(SETTINGS, slider, gap, 0.0, 0.0)[0] for gap in (0.03, 0.004, 0.0006)
    )
    assert far == pytest.approx(SETTINGS.speed)
    assert far > near > touching > 0.0


def test_a_picture_that_froze_while_the_tip_moved_on_is_no_departure(slider) -> None:
    assert not departure(slider, -0.008, 0.01)


def test_a_tip_in_front_of_the_face_has_not_left(slider) -> None:
    assert all(not departure(slider, gap, p_y) for gap in (0.0, -1e-3, 0.1) for p_y in (0.0, 0.06))
