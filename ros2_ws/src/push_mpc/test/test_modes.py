"""The table of the controller's modes, and every controller that keeps to it."""

import re
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)
from push_core.geometry import to_world
from push_mpc.loop.modes import FOLLOWING, TRANSITIONS, Event, Mode, ModeMachine, state_diagram
from push_msgs.msg import ControllerState

PAGE = Path(__file__).parents[4] / 'docs' / 'operating.md'
STOPS = (Event.STOP, Event.FAIL)


def path_to(mode: Mode) -> list[Event]:
    """Events that lead from IDLE to a mode, by breadth-first search in the table."""
    paths: dict[Mode, list[Event]] = {Mode.IDLE: []}
    waiting = [Mode.IDLE]
    while mode not in paths:
        here = waiting.pop(0)
        for (source, event), target in TRANSITIONS.items():
            if source == here and target not in paths:
                paths[target] = [*paths[here], event]
                waiting.append(target)
    return paths[mode]


def machine_in(mode: Mode) -> ModeMachine:
    machine = ModeMachine()
    for event in path_to(mode):
        machine.take(event, 'a reason' if event in STOPS else '')
    assert machine.mode == mode
    return machine


def test_the_numbers_are_those_of_the_message() -> None:
    assert {mode.name: int(mode) for mode in Mode} == {
        mode.name: getattr(ControllerState, mode.name) for mode in Mode
    }


@pytest.mark.parametrize('mode', Mode)
@pytest.mark.parametrize('event', Event)
def test_every_event_in_every_mode_does_what_the_table_says(mode, event) -> None:
    machine = machine_in(mode)
    assert machine.take(event, 'why') == ((mode, event) in TRANSITIONS)
    assert machine.mode == TRANSITIONS.get((mode, event), mode)


@pytest.mark.parametrize('mode', [Mode.STOPPED, Mode.FAULT])
def test_a_stop_is_left_by_resume_only(mode) -> None:
    assert [event for source, event in TRANSITIONS if source == mode] == [Event.RESUME]


@pytest.mark.parametrize('mode', Mode)
def test_from_every_mode_there_is_a_way_to_rest_and_a_stop_is_heard(mode) -> None:
    machine = machine_in(mode)
    machine.take(Event.STOP, 'asked to')
    machine.come_to_rest()
    assert machine.mode in (Mode.STOPPED, Mode.FAULT)
    assert machine.reason


@pytest.mark.parametrize('first', STOPS)
@pytest.mark.parametrize('second', STOPS)
def test_the_first_reason_is_kept_and_decides_where_it_ends(first, second) -> None:
    machine = machine_in(Mode.TRACKING)
    machine.take(first, 'first')
    machine.take(second, 'second')
    machine.come_to_rest()
    assert machine.reason == 'first'
    assert machine.mode == (Mode.STOPPED if first == Event.STOP else Mode.FAULT)
    machine.take(Event.RESUME)
    assert (machine.mode, machine.reason) == (Mode.IDLE, '')


def test_a_stop_after_the_end_of_the_reference_is_a_stop() -> None:
    machine = machine_in(Mode.TRACKING)
    machine.take(Event.END)
    machine.take(Event.STOP, 'asked to')
    machine.come_to_rest()
    assert (machine.mode, machine.reason) == (Mode.STOPPED, 'asked to')


def test_the_picture_of_the_page_is_the_table() -> None:
    (picture,) = re.findall(r'```mermaid\n(.*?)\n```', PAGE.read_text(encoding='utf-8'), re.DOTALL)
    assert picture == state_diagram()


def test_the_page_says_what_each_mode_means() -> None:
    rows = re.findall(r'^\| `([A-Z]+)` \|', PAGE.read_text(encoding='utf-8'), re.MULTILINE)
    assert rows == [mode.name for mode in Mode]


class AnyCommands(RuleBasedStateMachine):
    """A controller under any order of calls and poses, in a plant that obeys."""

    make_cell = None
    taken: ClassVar[set[tuple[Mode, Event]]] = set()

    @initialize()
    def begin(self) -> None:
        self.cell = type(self).make_cell()
        self.controller, self.now = self.cell.controller, 1.0
        self.before, self.latched = np.zeros(2), ''
        take = self.controller._machine.take

        def noted(event, reason=''):
            mode, happened = self.controller.mode, take(event, reason)
            if happened:
                self.taken.add((mode, event))
            return happened

        self.controller._machine.take = noted

    @rule()
    def arm(self) -> None:
        self.controller.arm()

    @rule()
    def begin_anew(self) -> None:
        self.controller.resume()
        self.controller.arm()
        self.latched = self.controller.stop_reason
        self.poses(5)

    @rule()
    def resume(self) -> None:
        self.controller.resume()
        if self.controller.mode == Mode.IDLE:
            self.latched = ''

    @rule(reason=st.sampled_from(['one', 'other']))
    def stop(self, reason) -> None:
        self.controller.stop(reason)

    @rule(count=st.integers(1, 12))
    def poses(self, count) -> None:
        for _ in range(count):
            self._check(self.cell.tick())

    @rule(ahead=st.floats(0.003, 0.05), aside=st.floats(-0.06, 0.06))
    def push_away(self, ahead, aside) -> None:
        pose = self.cell.plant.object_pose
        pose[:2] = to_world(pose, np.array([ahead, aside]))
        self.cell.plant._world.place_object(pose)
        self.poses(30)

    @rule(bad=st.sampled_from([np.nan, np.inf, -np.inf, 1e308, 5e-324]), entry=st.integers(0, 2))
    def bad_pose(self, bad, entry) -> None:
        pose = self.cell.seen.object_pose.copy()
        pose[entry] = bad
        self._check(self.cell.tick(pose))

    @rule(count=st.integers(1, 12))
    def no_pose(self, count) -> None:
        for _ in range(count):
            self._check(self.controller.hold(self.cell.plant.time - self.cell.plant.START))
            self.cell.plant.command(self.before, self.cell.plant.time)
            self.cell.seen = self.cell.plant.step()

    @precondition(lambda self: self.controller.mode in FOLLOWING)
    @rule()
    def run_out(self) -> None:
        self.controller._reference.start -= self.controller.plan.duration
        self._check(self.cell.tick())

    def _check(self, tick) -> None:
        limits, period = self.controller.settings.limits, self.controller.settings.period
        assert np.isfinite(tick.velocity).all()
        assert np.hypot(*tick.velocity) <= limits.speed * (1.0 + 1e-12)
        change = np.hypot(*(tick.velocity - self.before))
        assert change <= limits.acceleration * period * (1.0 + 1e-9)
        if tick.mode in (Mode.IDLE, Mode.ARMED, Mode.DONE, Mode.STOPPED, Mode.FAULT):
            assert not tick.velocity.any()
        self.before = tick.velocity

    @invariant()
    def the_first_reason_stays(self) -> None:
        if not hasattr(self, 'controller'):
            return
        if self.latched:
            assert self.controller.stop_reason == self.latched
        self.latched = self.controller.stop_reason
        stopped = self.controller.mode in (Mode.STOPPED, Mode.FAULT)
        assert not stopped or self.latched


def test_any_order_of_commands_and_poses_keeps_the_promises(cell) -> None:
    controller = cell.controller

    def fresh():
        controller._machine.take = type(controller._machine).take.__get__(controller._machine)
        cell.reset()
        return cell

    AnyCommands.make_cell = staticmethod(fresh)
    run_state_machine_as_test(
        AnyCommands,
        settings=settings(
            max_examples=max(settings.default.max_examples // 4, 1),
            stateful_step_count=25,
            deadline=None,
            derandomize=True,
        ),
    )
    # the examples are always the same, and take every kind of event but those of a broken solver
    assert {event for _, event in AnyCommands.taken} >= set(Event) - {Event.FAIL, Event.FAILED}
