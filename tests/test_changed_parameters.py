"""Parameters that change during runs are in the bag, which still recomputes bit for bit."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from cell_command import Ended
from graph_by_hand import GraphByHand
from push_bag.score.score import score_run
from push_bag.score.score_table import score_table
from push_msgs.msg import ControllerState
from push_node import interface

pytestmark = pytest.mark.processes

LOCKSTEP = 'mode:=lockstep'
WEIGHTS = {
    'gp': {'weights.position_x': 800.0, 'weights.contact': 30.0},
    'analytical': {'force_weights.position_x': 800.0, 'force_weights.contact': 3.0},
}


@pytest.fixture(params=['gp', 'analytical'])
def controller(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def graph(environment: dict[str, str], controller: str, tmp_path: Path) -> Iterator[GraphByHand]:
    """A cell in lockstep on the line."""
    graph = GraphByHand(environment, tmp_path)
    graph.start('recorder', 'folder:=run')
    graph.start('sim_node', LOCKSTEP, 'seed:=3')
    graph.start('gp_server', 'model:=analytical')
    graph.start('mpc_node', LOCKSTEP, 'track:=line', 'speed:=0.15', f'controller:={controller}')
    yield graph
    graph.close()


def begin(graph: GraphByHand) -> None:
    graph.call_until_success(interface.RESET_TO_PLAN)
    graph.call_until_success(interface.START)
    graph.states.clear()


def change_during_a_run(graph: GraphByHand, controller: str) -> None:
    """Changes each kind of parameter, each while the tip moves."""
    graph.wait(lambda: 0.3 < graph.reference_time < 1.0)
    assert graph.set('mpc_node', **WEIGHTS[controller]) == ''
    assert graph.set('sim_node', **{'world.friction_pusher': 0.25}) == ''
    graph.wait(lambda: graph.reference_time > 0.8)
    limits = {'limits.speed': 0.2, 'normal_speed_limit': 0.19, 'disturbance_length': 0.02}
    assert graph.set('mpc_node', **limits) == ''
    graph.wait(lambda: graph.reference_time > 1.2)
    assert graph.set('mpc_node', **{'recontact.gap': 0.003, 'limits.acceleration': 2.0}) == ''
    wait_for_the_end(graph)


def wait_for_the_end(graph: GraphByHand) -> None:
    # the newest tick may still be one of the run before
    graph.wait(lambda: graph.mode == ControllerState.TRACKING)
    graph.wait(lambda: graph.mode == ControllerState.DONE)


def test_a_bag_knows_at_which_tick_a_change_took_effect(
    graph: GraphByHand, controller: str, environment: dict[str, str], tmp_path: Path
) -> None:
    begin(graph)
    change_during_a_run(graph, controller)
    # between two runs, and between start and first tick
    assert graph.set('mpc_node', **{'weights.heading': 3.0, 'force_weights.heading': 3.0}) == ''
    begin(graph)
    assert graph.set('mpc_node', tangential_speed_limit=0.1) == ''
    wait_for_the_end(graph)
    assert graph.end('recorder') == 0

    first, second = score_run(tmp_path / 'run')['starts']
    assert first['completed']
    assert second['completed']
    changes = first['parameter_changes']
    nodes = [change['node'] for change in changes]
    assert nodes == ['mpc_node', 'sim_node', 'mpc_node', 'mpc_node']
    assert changes[0]['parameters'] == WEIGHTS[controller]
    assert 0.0 < changes[0]['time_s'] < changes[3]['time_s']
    assert 'sim_node.world.friction_pusher=0.25' in score_table(first)
    # those of the first run are in effect in the second
    assert [change['time_s'] < 0.0 for change in second['parameter_changes']][:5] == [True] * 5
    assert len(second['parameter_changes']) == 6
    again = Ended.of_command(
        environment, 'ros2', 'run', 'push_bag', 'replay', str(tmp_path / 'run'), '--recompute'
    )
    assert again.status == 0, again.out + again.err
    same, _, count, *_ = again.out.split()
    assert int(same) == int(count) > 600
