"""Plant and controller on two machines, for which two network namespaces stand.

The lap is in real time and judged against the limits that docs/two_machines.md states.
"""

import os
import shutil
from pathlib import Path

import pytest
from push_bag.score.score import score_series
from two_machines import NoNamespacesError, machines, measured, pushed

pytestmark = [
    pytest.mark.processes,
    pytest.mark.skipif(os.geteuid() != 0, reason='network namespaces need root'),
    pytest.mark.skipif(shutil.which('ip') is None, reason='needs iproute2'),
    pytest.mark.skipif(not Path('/dev/net/tun').exists(), reason='the kernel has no TAP devices'),
]

LARGEST_ERROR = 1.2e-3  # [m]; of a circle in one process 0.3 mm, in real time on busy cores more


@pytest.mark.parametrize(
    ('link', 'lossless', 'way'),
    [
        (('--delay', '0.2'), True, (0.2, 3.0)),
        (('--delay', '5', '--jitter', '2', '--loss', '0.5'), False, (3.0, 8.0)),
    ],
    ids=['0.2 ms', '5 ms, jitter, loss'],
)
def test_a_lap_over_a_network_is_completed_and_tells_the_way(
    environment: dict[str, str],
    tmp_path: Path,
    link: tuple[str, ...],
    lossless: bool,
    way: tuple[float, float],
) -> None:
    try:
        with machines(*link):
            run = pushed(environment, tmp_path / 'run')
    except NoNamespacesError as error:
        pytest.skip(f'no network namespaces here: {error}')
    if run.stop_reason:
        pytest.skip(f'the machine is too busy for a run in real time: {run.stop_reason}')
    score = score_series(run)
    told, offset = measured(tmp_path / 'run')
    assert way[0] <= told <= way[1]
    assert abs(offset) < 5.0
    assert score['completed']
    assert 1e-3 * score['tracking_error_mm']['mean'] < LARGEST_ERROR
    if lossless:
        assert score['messages']['/pusher_velocity_cmd']['lost'] == 0
