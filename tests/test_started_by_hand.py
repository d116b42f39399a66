"""Nodes in lockstep that a person starts, who takes seconds between two commands."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from graph_by_hand import GraphByHand
from push_core.physics.slider import Slider
from push_msgs.srv import Reset
from push_node import interface

pytestmark = pytest.mark.processes

LOCKSTEP = 'mode:=lockstep'
PACE = 1.5  # [s] between two commands


@pytest.fixture
def graph(environment: dict[str, str], tmp_path: Path) -> Iterator[GraphByHand]:
    """A plant and a controller with a model, ready for a start."""
    graph = GraphByHand(environment, tmp_path)
    graph.start('sim_node', LOCKSTEP)
    graph.start('gp_server', 'model:=analytical')
    options = ('track:=line', 'controller:=analytical', 'require_recorder:=false')
    graph.start('mpc_node', LOCKSTEP, *options)
    for service in (interface.RESET_TO_PLAN, interface.START, interface.STOP, interface.RESUME):
        graph.call_until_success(service)
    yield graph
    graph.close()


def slowly(graph: GraphByHand, service: object, request: object = None) -> str:
    """The answer of a service to a person."""
    graph.happens(lambda: False, PACE)
    return str(graph.call(service, request).message)


def test_a_start_is_accepted_at_the_pace_of_a_person(graph: GraphByHand) -> None:
    slowly(graph, interface.RESET_TO_PLAN)
    # the first one may still have to forget the time before the reset
    answers = [slowly(graph, interface.START) for _ in range(2)]
    assert any('armed' in answer for answer in answers), answers


def test_a_start_looks_where_the_object_is_after_a_second_reset(graph: GraphByHand) -> None:
    slowly(graph, interface.RESET_TO_PLAN)
    slowly(graph, interface.RESET_TO_PLAN)
    pose = [0.1, 0.05, 0.2]
    request = Reset.Request(object_pose=pose, tip_position=Slider().tip_position(pose, 0.0))
    slowly(graph, interface.RESET, request)
    answers = [slowly(graph, interface.START) for _ in range(2)]
    assert 'from the start of the plan' in answers[-1], answers
