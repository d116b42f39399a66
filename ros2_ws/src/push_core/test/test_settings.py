import math
from dataclasses import FrozenInstanceError, dataclass

import pytest
from push_core.common.errors import InputError
from push_core.common.settings import (
    Described,
    checked,
    flatten,
    nested,
    replaced,
    setting,
    unused_names,
    validate,
)


@dataclass(frozen=True)
class Engine:
    power: float = setting(2.0, 'power', unit='W', low=0.0, high=10.0)

    def __post_init__(self) -> None:
        validate(self)


@dataclass(frozen=True)
class Car:
    wheels: int = setting(4, 'number of wheels', low=3, high=8)
    colour: str = setting('red', 'paint', choices=('red', 'blue'))
    open_roof: bool = setting(False, 'whether the roof is open')
    engine: Engine = nested(Engine())

    def __post_init__(self) -> None:
        validate(self)


def test_nested_settings_have_dotted_names_in_their_order() -> None:
    assert list(flatten(Car())) == ['wheels', 'colour', 'open_roof', 'engine.power']
    value, described = flatten(Car())['engine.power']
    assert value == 2.0
    assert (described.text, described.range_text()) == ('power', 'between 0 and 10 W')


def test_changes_make_a_new_object_and_leave_the_old_one() -> None:
    old = Car()
    new = replaced(old, {'engine.power': 3.0, 'colour': 'blue'})
    assert (new.engine.power, new.colour, new.wheels) == (3.0, 'blue', 4)
    assert old == Car()


def test_a_number_will_do_for_a_word() -> None:
    word = Described('heading', '', -math.inf, math.inf, ())
    assert [checked('heading', value, 'free', word) for value in (30, 2.5)] == ['30', '2.5']


def test_a_whole_number_will_do_for_a_float() -> None:
    power = replaced(Car(), {'engine.power': 3}).engine.power
    assert type(power) is float


@pytest.mark.parametrize('edge', [0.0, 10.0])
def test_both_ends_of_a_range_belong_to_it(edge) -> None:
    assert replaced(Car(), {'engine.power': edge}).engine.power == edge


@pytest.mark.parametrize(
    ('name', 'value', 'fault'),
    [
        ('engine.power', 10.1, 'parameter engine.power is 10.1, must be between 0 and 10 W'),
        ('engine.power', -1, 'parameter engine.power is -1, must be between 0 and 10 W'),
        ('engine.power', math.nan, 'parameter engine.power is nan, must be between 0 and 10 W'),
        ('engine.power', math.inf, 'parameter engine.power is inf, must be between 0 and 10 W'),
        ('engine.power', 'much', "parameter engine.power takes float, not 'much'"),
        ('engine.power', True, 'parameter engine.power takes float, not True'),
        ('wheels', 2, 'parameter wheels is 2, must be between 3 and 8'),
        ('wheels', 4.0, 'parameter wheels takes int, not 4.0'),
        ('wheels', True, 'parameter wheels takes int, not True'),
        ('open_roof', 1, 'parameter open_roof takes bool, not 1'),
        ('colour', 'green', "parameter colour is 'green', must be one of red, blue"),
        ('engine', 3.0, "unknown parameter 'engine'; known: colour, engine.power, open_roof"),
        ('power', 3.0, "unknown parameter 'power'; known: colour, engine.power, open_roof"),
    ],
)
def test_a_bad_value_is_refused_by_its_name(name, value, fault) -> None:
    with pytest.raises(InputError) as caught:
        replaced(Car(), {name: value})
    assert str(caught.value).startswith(fault)
    assert caught.value.status == 2


def test_a_settings_object_cannot_be_built_or_made_wrong() -> None:
    with pytest.raises(InputError, match='power is 11, must be between'):
        Engine(power=11.0)
    with pytest.raises(FrozenInstanceError):
        Engine().power = 11.0


@dataclass(frozen=True)
class Trailer:
    load: float = setting(1.0, 'load', low=0.0)
    engine: Engine = nested(Engine(), {'power': 'the car pulls'})

    def __post_init__(self) -> None:
        validate(self)


def test_what_a_component_does_not_read_is_no_parameter_and_says_what_to_do_instead() -> None:
    assert list(flatten(Trailer())) == ['load']
    assert unused_names(Trailer()) == {'engine.power': 'the car pulls'}
    with pytest.raises(InputError) as caught:
        replaced(Trailer(), {'engine.power': 3.0}, 'trailer')
    expected = "parameter 'engine.power' of trailer would have no effect: the car pulls"
    assert str(caught.value) == expected
    assert replaced(Trailer(), {'load': 2.0}).engine == Engine()
