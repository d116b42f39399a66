"""Every controller of the registry."""

import math
from dataclasses import replace
from pkgutil import resolve_name

import numpy as np
import pytest
from push_core.common.settings import replaced
from push_mpc.loop.controller import Mode
from push_mpc.loop.tracker import horizon_stride
from push_mpc.plan.planning import planned
from push_mpc.settings.controller_settings import ControllerSettings
from push_mpc.settings.controllers import CONTROLLERS
from push_mpc.settings.node_settings import mpc_settings
from push_sim.settings.plant_settings import PerturbationKind


@pytest.mark.parametrize('name', CONTROLLERS)
def test_it_is_a_choice_of_the_settings_and_tracks(name: str, make_cell) -> None:
    cell = make_cell(replace(mpc_settings('irb120'), controller=name))
    cell.controller.arm()
    ticks = [cell.tick() for _ in range(150)]
    assert ticks[-1].mode == Mode.TRACKING
    error = ticks[-1].state[:2] - cell.controller.plan.at(ticks[-1].reference_time)[0][:2]
    assert np.hypot(*error) < 2e-3
    assert np.hypot(*ticks[-1].velocity) > 0.04


@pytest.mark.parametrize('name', CONTROLLERS)
def test_its_steering_has_solvers_of_its_own(name: str) -> None:
    settings = ControllerSettings()
    steering_class = resolve_name(CONTROLLERS[name].steering)
    first, second = (
        steering_class(settings, mpc_settings('irb120').slider, 0.08) for _ in range(2)
    )
    assert first.solvers
    assert not {*map(id, first.solvers)} & {*map(id, second.solvers)}


CHANGED = {
    'weights.contact': 100.0,
    'force_weights.contact': 3.0,
    'normal_speed_limit': 0.09,
    'tangential_speed_limit': 0.04,
    'limits.speed': 0.1,
    'limits.acceleration': 3.0,
    'disturbance_length': 0.02,
}


def run(cell) -> list[list[float]]:
    """Commands of the first second of a run, with a kick on the way."""
    cell.controller.arm()
    velocities = []
    for number in range(100):
        if number == 60:
            cell.disturb(PerturbationKind.TANGENTIAL, 0.01)
        velocities.append(cell.tick().velocity.tolist())
    return velocities


@pytest.mark.parametrize('name', CONTROLLERS)
def test_changed_settings_are_followed_as_if_the_controller_had_been_made_with_them(
    name: str, make_cell
) -> None:
    settings = replace(mpc_settings('irb120'), controller=name)
    changed = replaced(settings, CHANGED)
    cell = make_cell(settings)
    before = run(cell)
    cell.controller.change(changed)
    cell.reset()
    after = run(cell)
    assert after == run(make_cell(changed))
    assert after != before
    assert max(math.hypot(*velocity) for velocity in after) <= 0.1 + 1e-9
    assert max(math.hypot(*velocity) for velocity in before) > 0.1


@pytest.mark.parametrize('name', CONTROLLERS)
def test_a_run_depends_on_none_before_it(name: str, make_cell) -> None:
    cell = make_cell(replace(mpc_settings('irb120'), controller=name))
    first = run(cell)
    cell.reset()
    assert run(cell) == first


@pytest.mark.parametrize('name', CONTROLLERS)
def test_a_model_that_was_prepared_before_a_change_keeps_the_changed_limits(
    name: str, make_cell, table
) -> None:
    cell = make_cell(replace(mpc_settings('irb120'), controller=name))
    prepared = cell.controller.prepare_model(table, 'earlier')
    cell.controller.change(replaced(cell.controller.settings, CHANGED))
    cell.controller.use(prepared)
    fresh = cell.controller.prepare_model(table, 'later').staged.stages
    for one, other in zip(cell.controller._model.staged.stages, fresh, strict=True):
        assert np.array_equal(one.high, other.high)
        assert np.array_equal(one.low, other.low)


@pytest.mark.parametrize(
    ('name', 'slow', 'fast'), [('gp', 0.05, 0.05), ('analytical', 0.05, 0.109)]
)
def test_the_model_error_changes_no_faster_than_commands_can_answer(
    name: str, slow: float, fast: float
) -> None:
    settings = replace(mpc_settings('irb120'), controller=name)
    assert settings.filter_length(0.08) == slow
    assert settings.filter_length(0.2) == pytest.approx(fast)
    assert replace(settings, disturbance_length=0.0).filter_length(0.2) == 0.0


@pytest.mark.parametrize(('name', 'slow', 'fast'), [('gp', 5, 2), ('analytical', 5, 3)])
def test_the_horizon_is_long_enough_at_speed(name: str, slow: int, fast: int) -> None:
    settings = replace(mpc_settings('irb120'), controller=name, speed=0.08)
    plan = planned(settings)
    assert horizon_stride(plan, settings) == slow
    quick = planned(replace(settings, speed=0.22))
    assert horizon_stride(quick, settings) == fast
