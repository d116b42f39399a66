"""Where a controller that learns waits for what the last lap taught."""

import math

import numpy as np
from push_core.tracks import PIECE
from push_mpc.loop import Mode, Tick
from push_mpc.node.lap_gate import LapGate, Taught

SPEED = 0.08


def tick(time: float, mode: Mode = Mode.TRACKING, exposure: float = 0.0) -> Tick:
    return Tick(mode, np.zeros(2), reference_time=time, exposure=exposure)


def test_it_expects_a_lesson_after_each_lap_and_one_after_the_end():
    gate = LapGate(30.0, 3, SPEED)
    gate.begin(Taught())
    expected = []
    for time in (-0.01, 9.99, 10.0, 10.01, 19.99, 20.0, 29.99):
        gate.note(tick(time))
        expected.append(gate.expected.laps)
    assert expected == [0, 0, 1, 1, 1, 2, 2]
    for mode in (Mode.STOPPING, Mode.DONE, Mode.DONE):
        gate.note(tick(-math.inf, mode))
    assert gate.expected.laps == 3
    gate.begin(Taught(3))
    gate.note(tick(0.0, Mode.ARMED))
    gate.note(tick(10.0))
    assert gate.expected.laps == 4


def test_a_tick_without_poses_ends_no_lap():
    gate = LapGate(20.0, 2, SPEED)
    gate.begin(Taught())
    gate.note(tick(10.5, exposure=math.nan))
    assert gate.expected.laps == 0


def test_a_run_that_stops_teaches_what_it_has_completed():
    gate = LapGate(30.0, 3, SPEED)
    gate.begin(Taught())
    for each in (tick(11.0), tick(12.0, Mode.STOPPING), tick(12.0, Mode.STOPPED)):
        gate.note(each)
    assert gate.expected.laps == 1


def test_it_expects_a_lesson_after_each_piece_of_path_also_of_the_last_lap():
    gate, piece = LapGate(30.0, 1, SPEED), PIECE / SPEED
    gate.begin(Taught(2, 7))
    expected = []
    for time in (0.99 * piece, piece, 1.01 * piece, 2.0 * piece, 29.99):
        gate.note(tick(time))
        expected.append(gate.expected)
    assert expected == [(2, 7), (2, 8), (2, 8), (2, 9), (2, 10)]
    assert Taught(3, 9).lacks(gate.expected)
    assert Taught(1, 10).lacks(gate.expected)
    assert not Taught(2, 10).lacks(gate.expected)
