"""The fault campaign as a user runs it; the whole of it takes an hour."""

import json

import pytest
from cell_command import Ended

FAULTS = ('ros2', 'run', 'push_bringup', 'faults')


@pytest.mark.processes
def test_a_stop_in_time_and_a_killed_controller(environment: dict[str, str]) -> None:
    run = Ended.of_command(environment, *FAULTS, '--only', 'stop', 'kill_mpc_node', '--json')
    result = json.loads(run.out)
    assert (run.status, result['unexplained']) == (0, []), run.err
    assert (result['cases'], set(result['by_fault'])) == (2, {'stop', 'kill_mpc_node'})
    for row in result['by_fault'].values():
        assert 0.0 <= row['longest_rest_s'] < 0.3


def test_an_unknown_fault_is_refused(environment: dict[str, str]) -> None:
    run = Ended.of_command(environment, *FAULTS, '--only', 'earthquake')
    assert run.status == 2
    assert 'earthquake' in run.err
