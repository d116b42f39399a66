"""Every parameter of gp_server that is listed changes its answers, or is refused."""

import numpy as np
import pytest
from push_core.common import InputError, flatten, replaced, unused_names
from push_core.geometry import Array
from push_gp.models.model_file import model_named
from push_gp.server.server_settings import ServerSettings

# test_gp_server.py, test_model_server.py and tests/test_learning.py show what they do
TESTED_ELSEWHERE = {'model', 'max_points', 'learn', 'lesson', 'mode', 'slider.tip_radius'}
NAMES = sorted(set(flatten(ServerSettings())) - TESTED_ELSEWHERE)


def answers(settings: ServerSettings) -> Array:
    """Displacements (n, 3) by pushes that stick and pushes that slide."""
    model = model_named(settings.model, settings.slider, settings.distance)
    return model.evaluate(np.array([0.0, 0.02, -0.03]), np.array([1.5, 1.0, 2.5]))[0]


@pytest.mark.parametrize('name', NAMES)
def test_it_changes_the_answers(name: str) -> None:
    usual = ServerSettings()
    value, _ = flatten(usual)[name]
    assert not np.array_equal(answers(replaced(usual, {name: 0.5 * value})), answers(usual))


@pytest.mark.parametrize('name', unused_names(ServerSettings()))
def test_what_would_change_nothing_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=f"'{name}' of gp_server would have no effect"):
        replaced(ServerSettings(), {name: 1.0}, 'gp_server')
