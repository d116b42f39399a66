"""Parameter files as people and tools write them."""

import pytest
from push_bringup.setup.parameter_file import parsed_parameters
from push_core.common.errors import InputError

KNOWN = {'sim_node': ('seed', 'world.friction', 'mode'), 'mpc_node': ('speed', 'mode')}


def parsed(text: str, namespace: str = '') -> dict[str, dict[str, object]]:
    return parsed_parameters(text, 'mine.yaml', KNOWN, namespace)


@pytest.mark.parametrize(
    ('text', 'namespace'),
    [
        ('/**/sim_node: {ros__parameters: {world.friction: 0.2}}', ''),
        ('/**/sim_node: {ros__parameters: {world.friction: 0.2}}', 'lab/cell'),
        ('/sim_node: {ros__parameters: {world.friction: 0.2}}', ''),
        ('sim_node: {ros__parameters: {world.friction: 0.2}}', ''),
        ('sim_node: {ros__parameters: {world.friction: 0.2}}', 'cell'),
        ('sim_node: {ros__parameters: {world: {friction: 0.2}}}', ''),
        ('/cell/sim_node: {ros__parameters: {world.friction: 0.2}}', 'cell'),
        ('/cell: {sim_node: {ros__parameters: {world.friction: 0.2}}}', 'cell'),
        ('cell: {sim_node: {ros__parameters: {world.friction: 0.2}}}', 'cell'),
        ('/*/sim_node: {ros__parameters: {world.friction: 0.2}}', 'cell'),
        ('/lab/**: {ros__parameters: {world.friction: 0.2}}', 'lab/cell'),
        ('/**: {ros__parameters: {world.friction: 0.2}}', ''),
        ('/*: {ros__parameters: {world.friction: 0.2}}', ''),
        ('/**: {ros__parameters: {world.friction: 2e-1}}', ''),
        ('/**: {ros__parameters: {world.friction: 2.E-1}}', ''),
        ('/**: {ros__parameters: {world.friction: .2}}', ''),
        (
            '/**: {ros__parameters: {world.friction: 9.0}}\n'
            'sim_node: {ros__parameters: {world.friction: 0.2}}',
            '',
        ),
        (
            '/a/sim_node: {ros__parameters: {world.friction: 0.2}}\n'
            '/b/sim_node: {ros__parameters: {world.friction: 0.3}}',
            'a',
        ),
    ],
)
def test_every_form_that_ros_takes_is_read(text, namespace) -> None:
    assert parsed(text, namespace) == {'sim_node': {'world.friction': 0.2}, 'mpc_node': {}}


def test_a_block_for_all_nodes_gives_each_what_it_has() -> None:
    text = '/**:\n  ros__parameters:\n    mode: lockstep\n    seed: 3\n    speed: 1e-2\n'
    assert parsed(text) == {
        'sim_node': {'mode': 'lockstep', 'seed': 3},
        'mpc_node': {'mode': 'lockstep', 'speed': 0.01},
    }


def test_what_a_dump_adds_of_rclpy_is_left_out() -> None:
    text = (
        '/sim_node:\n  ros__parameters:\n    use_sim_time: false\n    seed: 3\n'
        '    start_type_description_service: true\n'
        '    qos_overrides: {/clock: {subscription: {depth: 1}}}\n'
    )
    assert parsed(text)['sim_node'] == {'seed': 3}


@pytest.mark.parametrize(
    ('text', 'fault'),
    [
        ('/**/robot: {ros__parameters: {seed: 3}}', "unknown block '/**/robot'"),
        ('sim_nod: {ros__parameters: {seed: 3}}', "unknown block '/**/sim_nod'"),
        ('/b/sim_node: {ros__parameters: {seed: 3}}', 'no parameter is for a node of namespace /'),
        ('/**: {ros__parameters: {sped: 3}}', "unknown parameter 'sped' of all nodes"),
        ('/**: {ros__parameters: {use_sim_time: true}}', 'use --mode lockstep'),
        ('sim_node: {seed: 3}', 'is not a parameter file'),
        ('sim_node: {ros__parameters: 3}', 'is not a parameter file'),
        ('seed: 3', 'is not a parameter file'),
        ('', 'is not a parameter file'),
        ('[1, 2]', 'is not a parameter file'),
        ('{', 'is not a parameter file'),
    ],
)
def test_another_one_is_refused_with_one_line(text, fault) -> None:
    with pytest.raises(InputError) as caught:
        parsed(text)
    assert str(caught.value).startswith('mine.yaml')
    assert fault in str(caught.value)
    assert '\n' not in str(caught.value)
