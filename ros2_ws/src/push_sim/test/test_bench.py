import json

import pytest
from push_core.common.settings import replaced
from push_core.physics.slider import Slider
from push_sim.commands import bench
from push_sim.commands.bench import main, memory_growth
from push_sim.settings.profiles import profile


def test_it_measures_and_says_so_in_one_json_object(capsys, monkeypatch) -> None:
    monkeypatch.setattr(bench, '_REPEATS', 1)
    assert main(['--engine', 'quasi_static', '--resets', '5', '--json']) == 0
    figures = json.loads(capsys.readouterr().out)
    assert figures['engine'] == 'quasi_static'
    assert figures['real_time_factor'] > 0.0
    assert figures['pushes_per_s'] > 0.0


def test_it_refuses_a_number_of_resets_that_makes_no_sense(capsys) -> None:
    assert main(['--resets', '0']) == 2
    assert 'must be between 1 and' in capsys.readouterr().err


@pytest.mark.parametrize(
    ('name', 'value', 'resets'),
    [('engine', 'bullet', 500), ('engine', 'quasi_static', 200), ('pressure', 'random', 100)],
)
def test_resets_leave_the_memory_as_it_is(slider: Slider, name, value, resets) -> None:
    settings = replaced(profile('irb120'), {f'world.{name}': value})
    assert abs(memory_growth(settings, slider, resets)) < 2.0
