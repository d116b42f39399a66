from dataclasses import replace

import pytest
from push_core.common.errors import InputError
from push_mpc.loop.tracker import horizon_stride
from push_mpc.plan.planning import planned
from push_mpc.settings.node_settings import mpc_settings

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
    with pytest.raises(
        InputError,
        match='track line is open and has no second lap; its end is 500 mm from its start',
    ):
        planned(replace(SETTINGS, track='line', laps=2))


def test_an_unknown_track_is_refused() -> None:
    with pytest.raises(InputError, match="unknown track 'nine'"):
        planned(replace(SETTINGS, track='nine'))


def test_an_unknown_profile_is_refused() -> None:
    with pytest.raises(InputError, match="profile is 'kuka', must be one of irb120, harsh"):
        mpc_settings('kuka')


def test_the_preset_of_the_paper_has_its_literal_weights_and_horizon() -> None:
    paper = mpc_settings('irb120', 'paper')
    weights = paper.weights
    state_weights = (weights.position_x, weights.position_y, weights.heading, weights.contact)
    assert state_weights == (6000.0, 3000.0, 10.0, 3000.0)
    assert (weights.normal, weights.tangential) == (10.0, 0.001)
    assert paper.horizon_steps == 35
    for speed in (0.02, 0.08):
        slow = replace(paper, speed=speed)
        assert horizon_stride(planned(slow), slow) * slow.period == 0.01


def test_an_unknown_preset_is_refused() -> None:
    with pytest.raises(InputError, match="preset is 'mine', must be one of tuned, paper"):
        mpc_settings('irb120', 'mine')


def test_a_track_that_asks_too_much_of_the_pusher_is_refused_with_the_place() -> None:
    with pytest.raises(InputError, match=r'needs a pusher speed of 0.3\d+ m/s near \d+ mm'):
        planned(replace(SETTINGS, track='square', speed=0.248))
    narrow = replace(SETTINGS, track='square', speed=0.1, tangential_speed_limit=0.05)
    with pytest.raises(InputError, match=r'\|v_t\| = 0.0\d+ m/s near \d+ mm .* limit is 0.05'):
        planned(narrow)


def test_a_track_that_will_be_moved_may_lie_anywhere_but_must_fit(tmp_path) -> None:
    here = replace(SETTINGS, start_from='here')
    path = tmp_path / 'far.csv'
    path.write_text('5,5\n5.1,5\n5.2,5.02\n5.3,5.02\n')
    with pytest.raises(InputError, match='leaves the workspace'):
        planned(replace(SETTINGS, track=str(path)))
    assert planned(replace(here, track=str(path))).duration > 3.0
    path.write_text('0,0\n100,0\n200,50\n300,50\n')
    with pytest.raises(InputError, match=r'304 m away from its start, .* look like millimetres'):
        planned(replace(here, track=str(path)))
