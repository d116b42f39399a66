"""Both ends of the documented range of every parameter of the plant work, or are refused."""

import math
import re
import warnings
from collections.abc import Iterator
from contextlib import closing

import pytest
from push_bringup.in_process.loop import InProcessCell
from push_bringup.setup.cell_parameters import installed_config, node_defaults, resolved
from push_bringup.setup.request import Request
from push_core.common import InputError, flatten
from push_core.physics import Slider
from push_gp.models import model_named
from push_mpc.plan import planned

TICKS = 12
LINE = Request(
    track='line', speed=0.1, controller='analytical', model='analytical', mode='inprocess'
)
# a plant and a controller of different sizes, or what only other parameters allow
REFUSED = {
    ('sim_node.world.substep', 0.01): 'must be a multiple of world.substep',
    ('sim_node.slider.side', 1.0): 'mm inside the object',
    ('sim_node.slider.tip_radius', 0.1): 'mm inside the object',
    ('sim_node.sensor.jitter', 0.1): 'must be less than the shortest time between two pictures',
}


def ends() -> Iterator[tuple[str, object]]:
    for name, (value, described) in flatten(node_defaults('irb120')['sim_node']).items():
        if name.startswith('start.') or name == 'mode':
            continue  # of the node alone
        prefix = '' if name.startswith('slider.') else 'sim_node.'
        if isinstance(value, bool):
            yield from ((prefix + name, end) for end in (False, True))
        elif isinstance(value, str):
            yield from ((prefix + name, choice) for choice in described.choices)
        else:
            limits = (described.low, described.high)
            yield from ((prefix + name, type(value)(end)) for end in limits if math.isfinite(end))
    yield from REFUSED


def reason_of_run(overrides: dict[str, object]) -> str:
    """Why a run of some ticks stopped."""
    few = {'consistent_plan': False, 'good_poses': 1}
    request = Request(**{**vars(LINE), 'overrides': {**few, **overrides}})
    parameters = resolved(request, installed_config('cell.yaml'))
    model = model_named('analytical', parameters.gp.slider)
    with closing(InProcessCell(parameters, model, planned(parameters.mpc))) as cell:
        left = iter(range(TICKS))

        def on_tick(*_tick: object) -> None:
            if next(left, None) is None:
                cell.controller.stop('enough')

        return cell.run(on_tick)


@pytest.mark.parametrize(('name', 'value'), list(dict.fromkeys(ends())))
def test_an_end_works_or_is_refused(name, value) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        if (name, value) in REFUSED:
            with pytest.raises(InputError, match=REFUSED[name, value]):
                reason_of_run({name: value})
        else:
            reason = reason_of_run({name: value})
            # noise and offsets as large as the object push the tip off its face, or end the run
            assert reason in ('', 'enough') or re.search('pushed face|from its reference', reason)


@pytest.mark.parametrize('engine', ['bullet', 'quasi_static'])
def test_a_point_pusher_pushes(engine) -> None:
    assert flatten(Slider())['tip_radius'][1].low == 0.0
    reason = reason_of_run({'slider.tip_radius': 0.0, 'world.engine': engine})
    assert reason == 'enough'
