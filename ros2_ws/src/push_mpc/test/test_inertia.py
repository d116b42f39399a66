"""The model at the speed of a plan, against the laws of motion of an object on an arc."""

import math
from dataclasses import replace

import numpy as np
import pytest
from push_core.physics import Slider
from push_core.physics.motion_cone import MotionCone
from push_mpc.loop.prepared_model import at_speed
from push_mpc.settings import mpc_settings
from push_mpc.table import Table, table_at_speed
from push_mpc.table.surrogate import Grid
from scipy.optimize import fsolve

SLIDER = Slider(friction_pusher=2.0)
GRID = Grid(np.linspace(-0.03, 0.03, 61), np.linspace(0.6, math.pi - 0.6, 121))
SPEED = 0.3


@pytest.fixture(scope='module')
def slow() -> Table:
    return Table(GRID, *MotionCone(SLIDER).evaluate(*GRID.points()))


def balanced(p_y: float, beta: float, speed: float) -> np.ndarray:
    """Twist per metre of tip travel of a contact that sticks, from Newton's and Euler's laws.

    The object turns steadily: its centre is accelerated by omega times its velocity.
    """
    tip = speed * np.array([math.sin(beta), math.cos(beta)])
    pull = SLIDER.friction_ground * 9.81

    def defect(twist: np.ndarray) -> tuple[float, float, float]:
        t_x, t_y, omega = twist
        size = math.hypot(t_x, t_y, SLIDER.support_radius * omega)
        force_x = pull * t_x / size - omega * t_y
        force_y = pull * t_y / size + omega * t_x
        moment = pull * SLIDER.support_radius**2 * omega / size
        return (
            (t_x - p_y * omega - tip[0]) / speed,
            (t_y + SLIDER.p_x * omega - tip[1]) / speed,
            (moment - SLIDER.p_x * force_y + p_y * force_x) / (pull * SLIDER.support_radius),
        )

    return fsolve(defect, [*tip, 0.0], xtol=1e-12) / speed


@pytest.mark.parametrize(('p_y', 'beta'), [(0.0, 1.4), (0.004, 1.5), (-0.006, 1.8), (0.002, 1.2)])
def test_a_fast_object_turns_as_newton_and_euler_say(slow, p_y, beta) -> None:
    expected = balanced(p_y, beta, SPEED)
    found = np.array(table_at_speed(slow, SLIDER, SPEED).rate(p_y, beta))
    without = np.array(slow.rate(p_y, beta))
    # e stands for v t_x / (mu g) with the speed of the plan, not that of this push
    assert np.abs(found - expected)[2] < 0.12 * np.abs(without - expected)[2]
    assert np.abs(found - expected)[:2].max() < 0.12 * np.abs(without - expected)[:2].max()


def test_the_contact_point_moves_with_the_tip_at_any_speed(slow) -> None:
    p_y, beta = GRID.points()
    rates, _ = table_at_speed(slow, SLIDER, SPEED).evaluate(p_y, beta)
    assert rates[:, 0] - p_y * rates[:, 2] == pytest.approx(np.sin(beta), abs=1e-9)
    assert rates[:, 1] + SLIDER.p_x * rates[:, 2] == pytest.approx(np.cos(beta), abs=1e-9)


def test_the_jacobian_is_the_derivative_of_the_rates(slow) -> None:
    fast, step = table_at_speed(slow, SLIDER, SPEED), 1e-6
    p_y, beta = np.array([-0.0101, 0.0033, 0.0171]), np.array([1.213, 1.577, 1.911])
    _, jacobian = fast.evaluate(p_y, beta)
    by_p_y = fast.evaluate(p_y + step, beta)[0] - fast.evaluate(p_y - step, beta)[0]
    by_beta = fast.evaluate(p_y, beta + step)[0] - fast.evaluate(p_y, beta - step)[0]
    assert jacobian[:, :, 0] == pytest.approx(by_p_y / (2.0 * step), abs=1e-3)
    assert jacobian[:, :, 1] == pytest.approx(by_beta / (2.0 * step), abs=1e-3)
    # the slopes at the grid points are the transformed ones: no bend between them
    middle = fast.evaluate(GRID.p_y[:-1] + 0.5e-3, np.full(60, 1.5))[0]
    ends = fast.evaluate(GRID.p_y, np.full(61, 1.5))[0]
    assert middle == pytest.approx(0.5 * (ends[1:] + ends[:-1]), abs=1e-3)


def test_a_slow_plan_leaves_the_model_alone(slow) -> None:
    p_y, beta = GRID.points()
    rates, _ = table_at_speed(slow, SLIDER, 1e-4).evaluate(p_y, beta)
    assert rates == pytest.approx(slow.evaluate(p_y, beta)[0], abs=1e-6)


@pytest.mark.parametrize(
    ('controller', 'identified', 'speed', 'changed'),
    [
        ('gp', False, 0.2, True),
        ('gp', True, 0.2, True),
        ('gp', True, 0.08, False),
        ('analytical', True, 0.2, True),
        ('analytical', False, 0.2, False),
    ],
)
def test_what_laps_identified_has_inertia_at_speed_with_every_controller(
    slow, controller, identified, speed, changed
) -> None:
    settings = replace(mpc_settings('irb120'), controller=controller)
    slider = Slider()
    table, fast = at_speed(slow, settings, slider, speed, identified=identified)
    assert (table is not slow) == changed
    assert (fast.support_radius > slider.support_radius) == changed
    assert (fast.friction_pusher > slider.friction_pusher) == changed
