"""Parameters without an effect in a run of the cell are refused."""

from dataclasses import replace
from pathlib import Path

import pytest
from push_bringup.setup.cell_parameters import installed_config, resolved
from push_bringup.setup.effect import check_effective
from push_bringup.setup.request import Request
from push_core.common.errors import InputError

REQUEST = Request(controller='analytical')


def check(request: Request) -> None:
    check_effective(request, resolved(request, installed_config('cell.yaml')))


@pytest.mark.parametrize(
    ('overrides', 'mode', 'fault'),
    [
        ({'start.theta': 3.14}, None, 'start.theta would have no effect'),
        ({'start.x': 0.3}, 'inprocess', 'start.x would have no effect'),
        ({'sim_node.start.gap': 0.5}, 'lockstep', 'start.gap would have no effect'),
        ({'recorder.folder': 'mine'}, None, 'use -o'),
        ({'facts_file': 'mine.json'}, None, 'facts_file would have no effect'),
        ({'mode': 'realtime'}, 'inprocess', 'mode would have no effect'),
        ({'sim_node.mode': 'lockstep'}, None, 'they must be the same'),
        ({'weights.contact': 100.0}, None, 'controller analytical has force_weights'),
        ({'controller': 'gp', 'model': 'x.npz', 'force_weights.slip': 1.0}, None, 'has weights'),
        ({'perturbation.magnitude': 0.01}, None, 'there is no perturbation'),
    ],
)
def test_an_override_without_an_effect_is_refused(overrides, mode, fault) -> None:
    with pytest.raises(InputError) as caught:
        check(replace(REQUEST, overrides=overrides, mode=mode))
    assert fault in str(caught.value)


@pytest.mark.parametrize(
    ('overrides', 'mode'),
    [
        ({}, None),
        ({'start.x': 0.0}, None),
        ({'start_offset.x': 0.01}, 'inprocess'),
        ({'start_from': 'here', 'start.x': 0.3}, 'lockstep'),
        ({'mode': 'lockstep'}, None),
        ({'mode': 'lockstep'}, 'inprocess'),
        ({'force_weights.slip': 1.0}, None),
        ({'perturbation.kind': 'normal', 'perturbation.magnitude': 0.01}, None),
        ({'mpc_node.pose_loss': 10.0}, 'inprocess'),
    ],
)
def test_one_with_an_effect_is_taken(overrides, mode) -> None:
    check(replace(REQUEST, overrides=overrides, mode=mode))


def test_a_model_for_a_controller_that_takes_none_is_refused_however_it_was_chosen() -> None:
    request = Request(model='my.npz', overrides={'controller': 'analytical'})
    with pytest.raises(InputError, match='--model is not for --controller analytical'):
        check(request)


def test_the_dumped_parameters_of_a_run_repeat_it(tmp_path: Path) -> None:
    first = replace(REQUEST, track='line', profile='harsh', seed=4, mode='lockstep')
    parameters = resolved(first, installed_config('cell.yaml'))
    dump = tmp_path / 'params.yaml'
    dump.write_text(parameters.as_yaml().replace("folder: ''", 'folder: of/another/run'))
    again = Request(params=dump)
    check(again)
    assert resolved(again, installed_config('cell.yaml')) == parameters
