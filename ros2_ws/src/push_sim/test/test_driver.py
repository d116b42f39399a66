import math

import numpy as np
import pytest
from push_core.physics.actuator import ACTUATORS
from push_sim.plant.driver import Driver

STEP = 0.001
FAST = np.array([0.2, 0.0])
CENTRE = np.zeros(2)


def velocities(driver: Driver, start: float, duration: float) -> np.ndarray:
    """Speed at the end of each millisecond."""
    speeds = []
    for step in range(round(duration / STEP)):
        driver.advance(start + step * STEP, STEP)
        speeds.append(driver.velocity[0])
    return np.array(speeds)


def test_a_step_rises_as_dead_time_and_lag_say() -> None:
    settings = ACTUATORS['irb120']
    driver = Driver(settings, timeout=10.0)
    driver.command(np.array([0.02, 0.0]), 0.0, CENTRE)
    speeds = velocities(driver, 0.0, 0.5)
    risen = STEP * (1 + np.argmax(speeds > 0.02 * (1.0 - math.exp(-1.0))))
    assert np.argmax(speeds > 0.0) * STEP == pytest.approx(settings.dead_time, abs=STEP)
    assert risen == pytest.approx(settings.dead_time + settings.lag, abs=STEP)


@pytest.mark.parametrize('name', ACTUATORS)
def test_the_watchdog_brakes_at_the_deceleration_limit_without_dead_time(name: str) -> None:
    settings = ACTUATORS[name]
    driver = Driver(settings, timeout=0.05)
    for tick in range(60):
        driver.command(FAST, tick * 0.01, CENTRE)
        velocities(driver, tick * 0.01, 0.01)
    speeds = velocities(driver, 0.6, 0.2)
    braking = speeds[speeds < speeds[0]]
    assert len(speeds) - len(braking) == pytest.approx(41, abs=1)
    assert -np.diff(braking).min() == pytest.approx(settings.deceleration_limit * STEP)
    assert speeds[-1] == 0.0


def test_a_command_from_before_a_stop_never_acts_after_it() -> None:
    driver = Driver(ACTUATORS['irb120'], timeout=0.05)
    driver.command(FAST, 0.0, CENTRE)
    velocities(driver, 0.0, 0.055)
    assert driver.braking
    assert not velocities(driver, 0.055, 0.2).any()


def test_commands_get_lost_at_the_stated_rate() -> None:
    driver = Driver(ACTUATORS['ideal'], timeout=10.0, loss=0.2)
    driver.reset(np.random.default_rng(0))
    heeded = 0
    for tick in range(2000):
        speed = 1e-5 * (tick + 1)
        driver.command(np.array([speed, 0.0]), tick * 0.01, CENTRE)
        heeded += velocities(driver, tick * 0.01, 0.01)[-1] == pytest.approx(speed)
    assert heeded / 2000 == pytest.approx(0.8, abs=0.03)


def test_new_commands_end_a_stop() -> None:
    driver = Driver(ACTUATORS['ideal'], timeout=0.05)
    velocities(driver, 0.0, 0.1)
    assert driver.braking
    driver.command(FAST, 0.1, CENTRE)
    assert velocities(driver, 0.1, 0.02)[-1] > 0.1
    assert not driver.braking


@pytest.mark.parametrize('bad', [math.nan, math.inf, -math.inf, 1e308])
def test_a_command_that_is_no_velocity_is_as_good_as_none(bad: float) -> None:
    driver = Driver(ACTUATORS['irb120'], timeout=0.05)
    for tick in range(30):
        driver.command(np.array([0.0, bad]), tick * 0.01, CENTRE)
        assert not velocities(driver, tick * 0.01, 0.01).any()
    assert driver.braking
    assert driver.limited == {'not_finite': 30}


@pytest.mark.parametrize('sign', [1.0, -1.0])
@pytest.mark.parametrize('axis', [0, 1])
def test_whoever_commands_the_tip_stays_in_the_workspace(axis: int, sign: float) -> None:
    driver, place = Driver(ACTUATORS['irb120'], timeout=0.05), np.zeros(2)
    reckless = sign * 2.0 * np.eye(2)[axis]
    for tick in range(600):
        driver.command(reckless, tick * 0.01, place)
        place = place + 0.01 * np.array(driver.advance(tick * 0.01, 0.01))
        assert np.all(np.abs(place) <= 0.6)
    assert np.abs(place[axis]) > 0.55
    assert driver.limited['workspace'] > 0
    assert driver.limited['speed'] == 600
