from dataclasses import dataclass
from pathlib import Path

import pytest
from push_core.common.errors import InputError
from push_core.common.settings import nested, setting, validate
from push_node.parameters import declared, override
from rclpy.parameter import Parameter

pytestmark = pytest.mark.processes


@dataclass(frozen=True)
class Engine:
    power: float = setting(2.0, 'power', unit='W', low=0.0, high=10.0)

    def __post_init__(self) -> None:
        validate(self)


@dataclass(frozen=True)
class Car:
    wheels: int = setting(4, 'number of wheels', low=3, high=8)
    colour: str = setting('red', 'paint', choices=('red', 'blue'))
    engine: Engine = nested(Engine())


def test_without_overrides_the_parameters_are_the_defaults(made_node) -> None:
    node = made_node()
    assert declared(node, Car()) == Car()
    assert node.get_parameter('engine.power').value == 2.0
    described = node.describe_parameter('engine.power')
    assert described.description == 'power'
    assert described.additional_constraints == (
        'between 0 and 10 W; read-only while the node runs'
    )


def test_the_command_line_overrides_by_dotted_name(made_node) -> None:
    node = made_node('tested', 'engine.power:=3.5', 'wheels:=6', 'colour:=blue')
    assert declared(node, Car()) == Car(wheels=6, colour='blue', engine=Engine(power=3.5))


def test_a_whole_number_will_do_for_a_float(made_node) -> None:
    power = declared(made_node('tested', 'engine.power:=3'), Car()).engine.power
    assert type(power) is float


def test_a_parameter_file_overrides_what_is_under_the_name_of_the_node(
    made_node, tmp_path: Path
) -> None:
    path = tmp_path / 'cell.yaml'
    path.write_text(
        '/**/tested:\n  ros__parameters:\n    engine:\n      power: 5.0\n    wheels: 3\n'
        '/**/another:\n  ros__parameters:\n    sails: 2\n'
    )
    node = made_node(file=path, namespace='cell_1')
    assert declared(node, Car()) == Car(wheels=3, engine=Engine(power=5.0))


@pytest.mark.parametrize(
    ('given', 'fault'),
    [
        ('engine.powr:=3.0', "unknown parameter 'engine.powr' of tested; known: colour, engine."),
        ('power:=3.0', "unknown parameter 'power' of tested"),
        ('engine.power:=11.0', 'parameter engine.power is 11, must be between 0 and 10 W'),
        ('engine.power:=.nan', 'parameter engine.power is nan, must be between 0 and 10 W'),
        ('engine.power:=much', "parameter engine.power takes float, not 'much'"),
        ('wheels:=4.0', 'parameter wheels takes int, not 4.0'),
        ('wheels:=true', 'parameter wheels takes int, not True'),
        ('colour:=green', "parameter colour is 'green', must be one of red, blue"),
    ],
)
def test_a_bad_override_is_refused_by_its_name(made_node, given, fault) -> None:
    with pytest.raises(InputError) as caught:
        declared(made_node('tested', given), Car())
    assert str(caught.value).startswith(fault)


def test_what_every_ros_node_knows_is_no_unknown_parameter(made_node) -> None:
    assert declared(made_node('tested', 'use_sim_time:=false'), Car()) == Car()


def test_parameters_stay_as_they_were_at_the_start(made_node) -> None:
    node = made_node()
    declared(node, Car())
    refused = node.set_parameters([Parameter('wheels', value=3)])[0]
    assert refused.reason == (
        'parameter wheels is read-only while the node runs; start it again to change it'
    )
    assert node.get_parameter('wheels').value == 4


def test_an_override_can_be_read_before_anything_is_declared(made_node) -> None:
    node = made_node('tested', 'colour:=blue')
    assert override(node, 'colour', 'red') == 'blue'
    assert override(node, 'wheels', 4) == 4
