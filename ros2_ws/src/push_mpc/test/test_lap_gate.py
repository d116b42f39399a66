"""Where a controller that learns waits for what the last lap taught."""

import math

import numpy as np
from push_mpc.loop import Mode, Tick
from push_mpc.node.lap_gate import LapGate


def tick(time: float, mode: Mode = Mode.TRACKING, exposure: float = 0.0) -> Tick:
    return Tick(mode, np.zeros(2), reference_time=time, exposure=exposure)


def test_it_expects_a_lesson_after_each_lap_and_one_after_the_end():
    gate = LapGate(30.0, 3)
    gate.begin(0)
    expected = []
    for time in (-0.01, 9.99, 10.0, 10.01, 19.99, 20.0, 29.99):
        gate.note(tick(time))
        expected.append(gate.expected)
    assert expected == [0, 0, 1, 1, 1, 2, 2]
    for mode in (Mode.STOPPING, Mode.DONE, Mode.DONE):
        gate.note(tick(-math.inf, mode))
    assert gate.expected == 3
    gate.begin(3)
    gate.note(tick(0.0, Mode.ARMED))
    gate.note(tick(10.0))
    assert gate.expected == 4


def test_a_tick_without_poses_ends_no_lap():
    gate = LapGate(20.0, 2)
    gate.begin(0)
    gate.note(tick(10.5, exposure=math.nan))
    assert gate.expected == 0


def test_a_run_that_stops_teaches_what_it_has_completed():
    gate = LapGate(30.0, 3)
    gate.begin(0)
    for each in (tick(11.0), tick(12.0, Mode.STOPPING), tick(12.0, Mode.STOPPED)):
        gate.note(each)
    assert gate.expected == 1
