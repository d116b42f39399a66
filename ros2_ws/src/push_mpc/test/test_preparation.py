"""Models prepared in a process of their own."""

import os
import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from push_core.common import InputError, RunError
from push_core.physics import MotionCone, Slider
from push_mpc.loop.controller import Controller
from push_mpc.node.preparation import Preparation
from push_mpc.settings.node_settings import mpc_settings

SETTINGS = replace(mpc_settings('irb120'), track='line')


@pytest.fixture
def preparation(plan_of, table):
    """A preparation whose process runs."""
    controller = Controller(SETTINGS, SETTINGS.slider, plan_of(SETTINGS))
    made = Preparation(SETTINGS, controller)
    made.prepare(table, 'first')
    yield made
    made.close()


@pytest.fixture
def other(tabulated):
    """The table of a square with more friction."""
    return tabulated(MotionCone(Slider(friction_pusher=0.4)))


def children() -> set[int]:
    listed = Path(f'/proc/self/task/{os.getpid()}/children').read_text(encoding='ascii')
    return {int(number) for number in listed.split()}


def test_the_process_gives_what_the_controller_itself_would_give(
    preparation, other, plan_of
) -> None:
    controller = Controller(SETTINGS, SETTINGS.slider, plan_of(SETTINGS))
    expected = controller.prepare_model(other, 'other')
    found = preparation.prepare(other, 'other')
    assert found.model_id == 'other'
    np.testing.assert_array_equal(found.plan.state, expected.plan.state)
    (ours,), (theirs,) = expected.staged.stages, found.staged.stages
    for name in ('target', 'low', 'high'):
        np.testing.assert_array_equal(getattr(theirs, name), getattr(ours, name))
    assert found.table.rate(0.01, 1.2) == other.rate(0.01, 1.2)


def test_a_model_that_cannot_be_used_is_refused_as_by_the_controller(preparation, other) -> None:
    other._coefficients[:] = np.inf
    with pytest.raises(InputError, match='implausibly large'):
        preparation.prepare(other, 'wild')


def test_after_the_process_was_killed_the_model_after_next_is_prepared(preparation, other) -> None:
    os.kill(preparation._process.pid, signal.SIGKILL)
    with pytest.raises(RunError, match='has ended'):
        preparation.prepare(other, 'lost')
    assert preparation.prepare(other, 'next').model_id == 'next'


def test_closing_ends_the_process(plan_of, table) -> None:
    before = children()
    made = Preparation(SETTINGS, Controller(SETTINGS, SETTINGS.slider, plan_of(SETTINGS)))
    assert children() <= before
    made.prepare(table, 'first')
    assert len(children() - before) == 1
    made.close()
    # those of other tests may end meanwhile
    assert children() <= before
