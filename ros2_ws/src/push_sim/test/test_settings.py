import pytest
from push_core.common.errors import InputError
from push_core.common.settings import flatten, replaced
from push_core.physics.actuator import ACTUATORS
from push_sim.node.node_settings import NodeSettings, node_settings
from push_sim.node.sim_node import main
from push_sim.settings.profiles import PROFILES, profile
from push_sim.settings.world_settings import ENGINE_NAMES
from push_sim.worlds.engines import ENGINES


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('world.friction_ground', -0.1),
        ('world.support_radius', 0.0),
        ('world.substep', 0.0),
        ('world.substep', 0.003),
        ('world.engine', 'ode'),
        ('world.pressure', 'elsewhere'),
        ('world.friction_variation', -0.1),
        ('world.friction_anisotropy', 0.0),
        ('world.mass_error', -1.0),
        ('world.size_error', -1.0),
        ('sensor.position_noise', -1e-3),
        ('sensor.tip_noise', -1e-3),
        ('sensor.tip_bias_x', 0.06),
        ('start_offset.theta', 1.1),
        ('perturbation.kind', 'sideways'),
        ('command_timeout', float('nan')),
        ('actuator.lag', -1.0),
    ],
)
def test_a_value_out_of_range_is_refused_by_name(name: str, value: object) -> None:
    with pytest.raises(InputError, match=name):
        replaced(profile('irb120'), {name: value})


@pytest.mark.parametrize(
    ('argument', 'told'),
    [
        ('world.friction_ground:=-0.1', 'world.friction_ground is -0.1, must be between 0.01 and'),
        ('world.substep:=0.003', 'world.substep is 0.003, must divide 0.01 s'),
        ('world.engine:=ode', "world.engine is 'ode', must be one of bullet, quasi_static"),
        ('world.mass_error:=-1.0', 'world.mass_error is -1, must be between -0.5 and 1'),
        ('world.size_error:=-1.0', 'world.size_error is -1, must be between -0.2 and 0.2'),
        ('profile:=harsher', "profile is 'harsher', must be one of irb120"),
    ],
)
def test_the_node_fails_at_its_start_with_one_line(argument: str, told: str, capfd) -> None:
    assert main(['--ros-args', '-p', argument]) == 2
    lines = [line for line in capfd.readouterr().err.splitlines() if 'parameter' in line]
    assert len(lines) == 1
    assert told in lines[0]


def test_an_unknown_profile_is_refused_with_those_that_exist() -> None:
    with pytest.raises(InputError, match='irb120'):
        profile('harsher')


@pytest.mark.parametrize('name', PROFILES)
def test_the_node_starts_from_its_profile(name: str) -> None:
    settings = node_settings(name)
    assert isinstance(settings, NodeSettings)
    assert settings.profile == name
    assert settings.sensor == PROFILES[name].sensor
    assert settings.actuator == PROFILES[name].actuator


def test_every_engine_can_be_chosen() -> None:
    assert set(ENGINE_NAMES) == set(ENGINES)


def test_every_profile_has_an_actuator_that_the_controller_knows() -> None:
    assert set(PROFILES) == set(ACTUATORS)


def test_every_parameter_is_described() -> None:
    for _, described in flatten(node_settings('irb120')).values():
        assert described.text
