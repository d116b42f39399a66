from dataclasses import replace

import pytest
from push_core.errors import InputError
from push_mpc.node_settings import mpc_settings
from push_mpc.planning import planned

SETTINGS = mpc_settings('irb120')


def test_the_plan_outlasts_horizon_and_delay() -> None:
    plan = planned(replace(SETTINGS, speed=0.02))
    horizon = SETTINGS.horizon_length / 0.02
    assert plan.time[-1] >= plan.duration + horizon + 0.11


def test_a_speed_beyond_the_robot_is_refused() -> None:
    with pytest.raises(InputError, match=r'speed is 0.3, must be between 0.001 and 0.25 m/s'):
        planned(replace(SETTINGS, speed=0.3))


def test_a_track_in_millimetres_is_refused_at_once(tmp_path) -> None:
    path = tmp_path / 'drawing.csv'
    path.write_text('0,0\n100,0\n200,50\n300,50\n')
    with pytest.raises(InputError, match=r'track drawing leaves the workspace .* in metres'):
        planned(replace(SETTINGS, track=str(path)))


def test_an_open_track_has_no_second_lap() -> None:
    with pytest.raises(InputError, match='track line is open and has no second lap'):
        planned(replace(SETTINGS, track='line', laps=2))


def test_an_unknown_track_is_refused() -> None:
    with pytest.raises(InputError, match="unknown track 'nine'"):
        planned(replace(SETTINGS, track='nine'))


def test_an_unknown_profile_is_refused() -> None:
    with pytest.raises(InputError, match="profile is 'kuka', must be one of irb120, harsh, ideal"):
        mpc_settings('kuka')
