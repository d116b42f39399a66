"""Every controller of the registry."""

from dataclasses import replace
from pkgutil import resolve_name

import numpy as np
import pytest
from push_mpc.loop.controller import Mode
from push_mpc.settings.controller_settings import ControllerSettings
from push_mpc.settings.controllers import CONTROLLERS
from push_mpc.settings.node_settings import mpc_settings


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
    first, second = (steering_class(settings, mpc_settings('irb120').slider) for _ in range(2))
    assert first.solvers
    assert not {*map(id, first.solvers)} & {*map(id, second.solvers)}
