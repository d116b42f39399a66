"""Overrides on the command line, `-p NAME:=VALUE`."""

import math

import pytest
from push_core.common.errors import InputError
from push_node.override_text import parsed_override


@pytest.mark.parametrize(
    ('value', 'expected'),
    [
        ('1e+05', 1e5),
        ('1e5', 1e5),
        ('5e-2', 0.05),
        ('1E-3', 1e-3),
        ('-2e+00', -2.0),
        ('.5', 0.5),
        ('2.', 2.0),
        ('1.5e3', 1500.0),
        ('.inf', math.inf),
        ('7', 7),
        ('true', True),
        ('eight', 'eight'),
        ('e5', 'e5'),
        ("'5e-2'", '5e-2'),
        ('track_5e2', 'track_5e2'),
    ],
)
def test_values_are_read_as_ros_reads_them(value, expected) -> None:
    assert parsed_override(f'speed:={value}') == ('speed', expected)
    assert type(parsed_override(f'speed:={value}')[1]) is type(expected)


@pytest.mark.parametrize('name', ['sim_node.seed', 'sim_node:seed', '/sim_node:seed'])
def test_a_node_is_named_with_a_point_or_as_ros_does(name) -> None:
    assert parsed_override(f'{name}:=3') == ('sim_node.seed', 3)


@pytest.mark.parametrize('text', ['speed', 'speed=3', ':=3', 'speed:=', 'speed:={'])
def test_another_form_is_refused(text) -> None:
    with pytest.raises(InputError, match='-p '):
        parsed_override(text)
