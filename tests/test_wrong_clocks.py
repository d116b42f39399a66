"""A few of the cells with wrong clocks; `tests/tools/cells/wrong_clocks.py` runs all."""

from pathlib import Path

import pytest
from node_tests import own_domain
from wrong_clocks import all_cases, faults_of

pytestmark = pytest.mark.processes

CASES = {case.name: case for case in all_cases()}


@pytest.mark.parametrize(
    'names',
    [
        ('lockstep, -0.02 s before the start', 'lockstep, -1 s during the run'),
        ('plant in lockstep, controller in realtime',),
        ('plant in realtime, controller in lockstep',),
    ],
    ids=['lockstep', 'plant in lockstep', 'controller in lockstep'],
)
def test_a_wrong_clock_neither_hangs_the_cell_nor_leads_the_object_astray(
    names: tuple[str, ...], environment: dict[str, str], tmp_path: Path
) -> None:
    # the relay of the last test is still known in its domain
    own = {**environment, 'ROS_DOMAIN_ID': own_domain()}
    for case, what, fault in faults_of([CASES[name] for name in names], own, tmp_path):
        assert not fault, (case.name, what)
