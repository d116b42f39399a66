"""Whatever a model says and wherever the object is: a valid command or a stated stop."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from push_core.common.errors import InputError
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider
from push_mpc.loop.controller import Controller, Mode
from push_mpc.plan.planning import planned
from push_mpc.settings.node_settings import mpc_settings
from push_mpc.table.surrogate import Grid, Table

GRID = Grid(np.linspace(-0.045, 0.045, 7), np.linspace(0.15, np.pi - 0.15, 9))
CONE = MotionCone(Slider()).evaluate(*GRID.points())
SETTINGS = {
    name: replace(
        mpc_settings('irb120'),
        controller=name,
        track='line',
        speed=0.1,
        good_poses=1,
        consistent_plan=False,
    )
    for name in ('gp', 'analytical')
}
PLANS = {name: planned(chosen) for name, chosen in SETTINGS.items()}
SIZES = st.floats(0.0, 308.0).map(lambda exponent: 10.0**exponent)
ODD = st.one_of(st.floats(-1.0, 1.0), st.sampled_from([0.0, -1.0]), SIZES)


@pytest.mark.filterwarnings('ignore::RuntimeWarning')
@settings(max_examples=15)
@given(
    controller=st.sampled_from(['gp', 'analytical']),
    scales=st.tuples(ODD, ODD),
    off=st.tuples(*(st.floats(-size, size) for size in (0.3, 0.3, 3.0, 0.06))),
)
@example(controller='analytical', scales=(1e307, 0.0), off=(0.0, 0.0, 0.0, 0.0))
def test_a_tick_ends_in_a_finite_command_or_a_stated_stop(controller, scales, off) -> None:
    chosen = SETTINGS[controller]
    made = Controller(chosen, chosen.slider, PLANS[controller])
    try:
        table = Table(GRID, scales[0] * CONE[0], scales[1] * CONE[1])
        made.use(made.prepare_model(table, 'odd'))
    except InputError:
        return
    made.arm()
    state = made.plan.state[0] + np.array(off)
    for count in range(4):
        tip = chosen.slider.tip_position(state[:3], state[3])
        tick = made.step(state[:3], tip, 0.01 * count, 0.01 * count + 0.005)
        assert np.isfinite(tick.velocity).all()
        assert np.hypot(*tick.velocity) <= chosen.limits.speed * (1 + 1e-12)
        if tick.mode == Mode.STOPPED:
            assert not tick.velocity.any()
            assert made.stop_reason
        made.prepare_next()


@pytest.mark.filterwarnings('ignore::RuntimeWarning')
def test_a_model_without_sense_is_refused_in_one_line(slider) -> None:
    chosen = SETTINGS['gp']
    made = Controller(chosen, slider, PLANS['gp'])
    with pytest.raises(InputError, match='implausibly large displacement'):
        made.prepare_model(Table(GRID, 1e300 * CONE[0], 1e300 * CONE[1]), 'huge')
