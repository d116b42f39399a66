"""Plans by collocation: sharp corners and prescribed headings."""

import math
import signal
import threading
import time
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from push_core.common.errors import InputError
from push_core.physics.motion_cone import MotionCone
from push_mpc.loop.controller import Mode
from push_mpc.motion.dynamics import rates
from push_mpc.plan.planning import planned
from push_mpc.settings.node_settings import mpc_settings
from scipy.integrate import solve_ivp

SETTINGS = replace(mpc_settings('irb120'), speed=0.1, good_poses=3)


def polyline(path, corners, spacing=0.01) -> str:
    """Writes points every centimetre along straight lines from corner to corner."""
    points = [corners[0]]
    for start, end in pairwise(corners):
        count = round(math.dist(start, end) / spacing)
        points += [
            [a + (b - a) * part / count for a, b in zip(start, end, strict=True)]
            for part in range(1, count + 1)
        ]
    path.write_text(''.join(f'{x},{y}\n' for x, y in points))
    return str(path)


@pytest.fixture(scope='module')
def corner(tmp_path_factory):
    path = tmp_path_factory.mktemp('track') / 'corner.csv'
    track = polyline(path, [(0, 0), (0.15, 0), (0.15, 0.15)])
    return replace(SETTINGS, track=track, controller='analytical', consistent_plan=False)


@pytest.fixture(scope='module')
def plan(corner, plan_of):
    return plan_of(corner)


def test_it_obeys_the_motion_equations_to_20_micrometres_a_tick(plan) -> None:
    """The velocity form, integrated anew over each period under the input of its start."""
    slider = SETTINGS.slider
    for sample in range(0, len(plan.state) - 1, 10):

        def motion(_time, state, held=plan.input[sample][None]):
            return rates(MotionCone(slider), state[None], held, slider.tip_x)[0]

        span = 0.0, plan.period
        reached = solve_ivp(motion, span, plan.state[sample], 'DOP853', rtol=1e-9, atol=1e-12)
        off = np.abs(reached.y[:, -1] - plan.state[sample + 1])
        assert np.all(off < [2e-5, 2e-5, 3e-4, 2e-5])


def test_it_follows_a_sharp_corner_within_the_limits(plan) -> None:
    place = SETTINGS.speed * plan.time
    wanted = np.column_stack([np.minimum(place, 0.15), np.clip(place - 0.15, 0.0, None)])
    away = np.hypot(*(plan.state[:, :2] - wanted).T)
    assert (away.mean() < 1.5e-3, away.max() < 10e-3) == (True, True)
    assert np.abs(plan.state[:, 3]).max() < 0.045
    assert np.all(plan.input[:, 0] >= -1e-9)
    assert np.abs(plan.input[:, 1]).max() <= SETTINGS.tangential_speed_limit + 1e-6


def test_the_corner_is_pushed_round_in_process(corner, make_cell) -> None:
    cell = make_cell(corner)
    cell.controller.arm()
    errors = []
    while (tick := cell.tick()).mode != Mode.DONE:
        assert tick.mode in (Mode.ARMED, Mode.TRACKING, Mode.STOPPING)
        if tick.mode == Mode.TRACKING and tick.reference_time > 0.0:
            reference = cell.controller.plan.at(tick.reference_time)[0]
            errors.append(math.hypot(*(tick.state[:2] - reference[:2])))
    assert np.mean(errors) < 5e-3


def test_headings_at_start_and_end_are_met() -> None:
    line = replace(SETTINGS, track='line', start_heading='20', end_heading='-30')
    plan = planned(line)
    assert np.degrees(plan.state[0, 2]) == pytest.approx(20.0, abs=1e-6)
    assert np.degrees(plan.at(plan.duration)[0][2]) == pytest.approx(-30.0, abs=1.0)


def test_the_flat_plan_can_be_asked_for_and_then_refuses_the_corner(corner) -> None:
    with pytest.raises(InputError, match=r'track corner turns too tightly near 1[45]\d mm'):
        planned(replace(corner, planner='flat'))


def test_a_track_that_nothing_can_follow_is_refused_with_its_place(tmp_path) -> None:
    back = polyline(tmp_path / 'back.csv', [(0, 0), (0.1, 0), (0, 0)])
    with pytest.raises(InputError, match=r'track back cannot be pushed near [12]\d\d mm along it'):
        planned(replace(SETTINGS, track=back))


def test_a_heading_that_is_no_number_is_refused() -> None:
    with pytest.raises(InputError, match="start_heading is 'north', must be a number of degrees"):
        planned(replace(SETTINGS, start_heading='north'))


@pytest.mark.parametrize('seconds', [0.05, 0.2, 0.4])
def test_ctrl_c_ends_it_at_once(seconds, capfd) -> None:
    settings = replace(SETTINGS, planner='optimal', track='eight')
    timer = threading.Timer(seconds, signal.pthread_kill, (threading.get_ident(), signal.SIGINT))
    started = time.thread_time()
    with pytest.raises(KeyboardInterrupt):
        timer.start()
        while timer.is_alive():  # a fast machine may be done with one plan before
            planned(settings)
    assert time.thread_time() - started < 2.0
    assert 'CasADi' not in capfd.readouterr().err
