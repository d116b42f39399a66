"""A new model in the middle of a lap."""

import math

import numpy as np
import pytest
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider
from push_mpc.loop.controller import Controller, Mode
from push_mpc.loop.tracker import Tracker


@pytest.fixture
def other(tracking, tabulated):
    """The same square with more friction, prepared as the worker prepares it."""
    table = tabulated(MotionCone(Slider(friction_pusher=0.4)))
    return tracking.controller.prepare_model(table, 'other')


def test_the_next_tick_uses_it_and_each_pose_is_answered(tracking, other) -> None:
    before = [tracking.tick() for _ in range(50)]
    tracking.controller.use(other)
    assert tracking.controller.model_id == 'other'
    after = [tracking.tick() for _ in range(150)]
    assert {tick.mode for tick in (*before, *after)} == {Mode.TRACKING}
    assert {tick.solver_status for tick in after} == {1}
    stamps = [tick.reference_time for tick in (*before, *after)]
    assert np.allclose(np.diff(stamps), 0.01, atol=1e-9)
    errors = [math.hypot(*(tick.state[:2] - tick.reference[:2])) for tick in after]
    assert max(errors) < 0.02


def test_taking_it_over_solves_and_prepares_nothing(tracking, other, monkeypatch) -> None:
    def busy(*_arguments: object) -> None:
        raise AssertionError('the 10 ms loop did the work of the worker')

    with monkeypatch.context() as patched:
        for name in ('solve', 'prepare', 'staged'):
            patched.setattr(Tracker, name, busy)
        patched.setattr(Controller, 'prepare_model', busy)
        tracking.controller.use(other)
    assert tracking.tick().solver_status == 1
