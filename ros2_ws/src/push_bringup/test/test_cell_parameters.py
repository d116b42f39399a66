"""Parameters of a run: file, request, overrides."""

from pathlib import Path

import pytest
import yaml
from push_bringup.commands.parameters import page
from push_bringup.setup.cell_parameters import (
    installed_config,
    recorded_in,
    recorded_parameters,
    resolved,
)
from push_bringup.setup.request import Request
from push_core.common.errors import InputError


def request(**changes):
    values = {
        'track': 'square',
        'speed': 0.05,
        'controller': 'gp',
        'model': 'model.npz',
        'profile': 'ideal',
        'perturb': 'normal',
        'laps': 2,
        'seed': 3,
        'preset': 'tuned',
        'mode': 'inprocess',
        'output': Path('runs'),
        'namespace': '',
        'overrides': {},
    }
    return Request(**{**values, **changes})


def resolve(**changes):
    return resolved(request(**changes), installed_config('cell.yaml'))


def test_the_request_reaches_every_node() -> None:
    parameters = resolve()
    assert parameters.sim.profile == parameters.mpc.profile == 'ideal'
    assert (parameters.sim.seed, parameters.sim.perturbation.kind) == (3, 'normal')
    assert (parameters.mpc.track, parameters.mpc.speed, parameters.mpc.laps) == ('square', 0.05, 2)
    assert parameters.gp.model == 'model.npz'


def test_a_recorded_run_names_its_folder_and_keeps_its_files(tmp_path) -> None:
    track = tmp_path / 'oval.csv'
    track.write_text('0,0\n')
    own = {'track': str(track), 'recorder.attachments': 'notes.txt'}
    recorder = recorded_in(resolve(overrides=own), Path('runs/run'), Path('inputs')).recorder
    assert (recorder.folder, recorder.facts_file) == ('runs/run', 'inputs/facts.json')
    assert recorder.attachments.splitlines() == [
        'inputs/params.yaml',
        'inputs/nominal_trajectory.csv',
        str(track),
        'notes.txt',
    ]


@pytest.mark.parametrize(
    ('name', 'value', 'node', 'attribute'),
    [
        ('profile', 'harsh', 'sim', 'profile'),
        ('seed', 9, 'sim', 'seed'),
        ('track', 'line', 'mpc', 'track'),
        ('speed', 0.03, 'mpc', 'speed'),
        ('controller', 'analytical', 'mpc', 'controller'),
        ('preset', 'paper', 'mpc', 'preset'),
        ('laps', 4, 'mpc', 'laps'),
    ],
)
def test_a_parameter_file_counts_where_no_option_is_given(
    name, value, node, attribute, tmp_path
) -> None:
    path = tmp_path / 'mine.yaml'
    path.write_text(f'/**:\n  ros__parameters: {{{name}: {value}}}\n')
    by_file = resolve(params=path, **{name: None})
    assert getattr(getattr(by_file, node), attribute) == value
    by_option = resolve(params=path)
    assert getattr(getattr(by_option, node), attribute) == getattr(request(), name)


def test_the_default_model_is_that_of_the_controller_however_it_was_chosen() -> None:
    assert resolve(model=None, overrides={'controller': 'analytical'}).gp.model == 'analytical'
    assert resolve(model=None, overrides={'gp_server.model': 'my.npz'}).gp.model == 'my.npz'


def test_what_was_changed_is_told_without_what_has_facts_of_its_own() -> None:
    assert resolve().changed() == ''
    changed = {'profile': 'irb120', 'seed': 5, 'mpc_node.actuator.lag': 0.02}
    assert resolve(overrides=changed).changed() == 'mpc_node.actuator.lag=0.02'
    shared = {'slider.tip_radius': 0.0}
    assert resolve(overrides=shared).changed() == 'slider.tip_radius=0.0'


def test_a_profile_brings_the_lag_of_its_robot_to_plant_and_predictor() -> None:
    for profile, dead_time in (('irb120', 0.06), ('ideal', 0.0)):
        parameters = resolve(profile=profile)
        assert parameters.sim.actuator == parameters.mpc.actuator
        assert parameters.mpc.actuator.dead_time == dead_time


def test_a_recording_of_a_time_with_more_parameters_can_be_read() -> None:
    text = resolve().as_yaml()
    older = text.replace(
        'slider.side: 0.09', 'slider.side: 0.09\n    slider.support_radius: 0.02', 1
    )
    assert older.index('slider.support_radius') < older.index('/**/gp_server')
    assert recorded_parameters(older, {}) == resolve()


def test_an_override_reaches_all_nodes_that_have_it_or_the_one_that_it_names() -> None:
    both = resolve(overrides={'actuator.lag': 0.02})
    assert both.sim.actuator.lag == both.mpc.actuator.lag == 0.02
    one = resolve(overrides={'sim_node.actuator.lag': 0.02})
    assert (one.sim.actuator.lag, one.mpc.actuator.lag) == (0.02, 0.0)


def test_a_parameter_file_comes_over_the_defaults_and_under_the_overrides(tmp_path: Path) -> None:
    path = tmp_path / 'fitted.yaml'
    path.write_text(
        '/**/sim_node:\n  ros__parameters: {actuator.lag: 0.04, world.stiffness: 2.0e+5}'
    )
    fitted = resolve(params=path, overrides={'actuator.lag': 0.03})
    assert (fitted.sim.world.stiffness, fitted.sim.actuator.lag) == (2e5, 0.03)
    assert resolve(params=path).sim.actuator.lag == 0.04


@pytest.mark.parametrize(
    ('text', 'fault'),
    [
        ('/**/sim_node:\n  ros__parameters: {world.mass: 1.0}', "unknown parameter 'world.mass'"),
        ('/**/robot:\n  ros__parameters: {}', "unknown block '/**/robot'"),
        ('/**/sim_node: 3', 'is not a parameter file'),
        ('3', 'is not a parameter file'),
        ('{', 'is not a parameter file'),
    ],
)
def test_a_faulty_parameter_file_is_refused(text: str, fault: str, tmp_path: Path) -> None:
    path = tmp_path / 'fitted.yaml'
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        resolve(params=path)
    assert fault in str(caught.value)
    with pytest.raises(InputError, match='No such file'):
        resolve(params=tmp_path / 'none.yaml')


def test_an_override_of_the_profile_brings_its_defaults() -> None:
    parameters = resolve(profile='irb120', overrides={'mpc_node.profile': 'ideal'})
    assert (parameters.sim.actuator.lag, parameters.mpc.actuator.lag) == (0.049, 0.0)


def test_the_written_file_names_every_value_of_every_node() -> None:
    parameters = resolve()
    blocks = yaml.safe_load(parameters.as_yaml())
    for node, values in parameters.by_node().items():
        assert blocks[f'/**/{node}']['ros__parameters'] == values


def test_an_unknown_parameter_in_the_file_is_refused(tmp_path) -> None:
    defaults = tmp_path / 'cell.yaml'
    defaults.write_text('/**/mpc_node:\n  ros__parameters:\n    speeed: 1.0\n')
    with pytest.raises(InputError, match='speeed'):
        resolved(request(), defaults)


def test_the_page_of_parameters_in_the_documentation_is_up_to_date() -> None:
    documented = Path(__file__).resolve().parents[4] / 'docs' / 'parameters.md'
    if not documented.exists():
        pytest.skip('the documentation is not beside this package')
    assert documented.read_text(encoding='utf-8') == page()
