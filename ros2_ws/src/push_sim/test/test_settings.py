import pytest
from push_core.errors import InputError
from push_core.settings import flatten, replaced
from push_sim.node_settings import NodeSettings, node_settings
from push_sim.settings import PROFILES, profile


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('world.friction_ground', -0.1),
        ('world.support_radius', 0.0),
        ('world.substep', 0.0),
        ('world.substep', 0.003),
        ('sensor.position_noise', -1e-3),
        ('perturbation.kind', 'sideways'),
        ('command_timeout', float('nan')),
        ('actuator.lag', -1.0),
    ],
)
def test_a_value_out_of_range_is_refused_by_name(name: str, value: object) -> None:
    with pytest.raises(InputError, match=name):
        replaced(profile('irb120'), {name: value})


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


def test_every_parameter_is_described() -> None:
    for _, described in flatten(node_settings('irb120')).values():
        assert described.text
