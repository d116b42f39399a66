"""Every parameter of mpc_node that is listed changes its commands, or is refused."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from push_core.common import InputError, flatten, replaced, unused_names
from push_core.geometry import Array
from push_core.physics import Slider
from push_mpc.loop.controller import Controller
from push_mpc.plan.nominal import Plan
from push_mpc.plan.planning import planned
from push_mpc.qp.steering import Move
from push_mpc.settings.node_settings import MpcSettings, mpc_settings
from push_mpc.table.surrogate import Table

# those of the node alone; test_mpc_node.py, test_pose_gate.py and test_planning.py cover them
OF_THE_NODE = {
    *('profile', 'preset', 'mode', 'start_from'),
    *('pose_timeout', 'pose_loss', 'require_recorder', 'learn'),
}
USUAL = replaced(
    mpc_settings('irb120'),
    {'speed': 0.1, 'good_poses': 2, 'consistent_plan': False, 'limits.reaction_time': 0.5},
)
OTHER = {
    'weights.smoothness': 3.0,
    'horizon_step': 0.05,
    'horizon_steps': 10,
    'track': 'line',
    'planner': 'optimal',
    'start_heading': '50',
    'end_heading': '50',
    'laps': 2,
    'good_poses': 4,
    'limits.dead_band': 0.01,
    'recontact.gap': 0.05,
    'guard.solver_failures': 2,
    'guard.catch_up': 0.3,
    'guard.tracking_error': 0.02,
}
NAMES = sorted(
    name
    for name in set(flatten(USUAL)) - OF_THE_NODE - {'controller'}
    if not name.startswith(('poses.', 'diagnostics.', 'realtime.'))
)
CONTROLLERS = ('gp', 'analytical')
TICKS = 95
BLIND, FROZEN = 16, 20  # ticks before which the poses are missing, or the controller as well
FAILING = range(24, 27)  # ticks in which the solver finds nothing


def poses(plan: Plan) -> list[tuple[Array, Array]]:
    """Object poses (3,) and tips (2,) about a plan: it swings, jumps, loses touch, freezes."""
    slider, found = Slider(), []
    for tick in range(TICKS):
        pose = plan.at(0.01 * max(tick - 14, 0))[0][:3]
        pose = pose + np.array([3e-3, -2e-3, 0.1]) * np.sin(tick / 6.0)
        pose[:2] -= 0.03 * (30 < tick < 45)
        gap = 0.03 if 50 < tick < 60 else -0.015 * (tick >= 60)
        found.append((pose, slider.tip_position(pose, 0.02 * np.sin(tick / 9.0), gap)))
    found[72:90] = [found[72]] * 18
    return found


def times() -> Array:
    """Exposures (TICKS,) [s] of the poses; twice none comes for 110 ms."""
    ticks = np.arange(TICKS)
    return 0.01 * ticks + 0.10 * (ticks >= BLIND) + 0.10 * (ticks >= FROZEN)


def no_solution(*_problem: object) -> Move:
    return Move(np.zeros(2), 3, 1, 'infeasible', np.empty((0, 4)))


@pytest.fixture(scope='module')
def settings(tmp_path_factory) -> MpcSettings:
    """Those of a line into the corner of the workspace."""
    track = tmp_path_factory.mktemp('track') / 'corner.csv'
    places = np.linspace(0.46, 0.58, 50)
    np.savetxt(track, np.column_stack([places, places]), delimiter=',')
    return replace(USUAL, track=str(track))


@pytest.fixture(scope='module')
def commands(table: Table, settings: MpcSettings) -> Callable[..., Array]:
    """The commands (n, 2) of a controller that answer the same poses, or go on without."""
    seen = poses(planned(settings))

    def answers(changed: MpcSettings, controller: str) -> Array:
        named = replace(changed, controller=controller)
        made = Controller(named, named.slider, planned(named))
        made.use(made.prepare_model(table, 'table'))
        made.arm()
        healthy, ticks = made._tracker.steering.solve, []
        for tick, (pair, exposure) in enumerate(zip(seen, times(), strict=True)):
            if tick == BLIND:
                ticks += [made.coast(exposure + 0.01 * late - 0.095) for late in range(10)]
            made._tracker.steering.solve = no_solution if tick in FAILING else healthy
            ticks.append(made.step(*pair, exposure, exposure + 0.005))
        return np.array([tick.velocity for tick in ticks])

    return answers


@pytest.fixture(scope='module')
def usual(commands, settings) -> dict[str, Array]:
    """What each controller commands."""
    return {name: commands(settings, name) for name in CONTROLLERS}


def test_the_poses_make_both_controllers_push(usual) -> None:
    for velocities in usual.values():
        assert np.count_nonzero(velocities.any(axis=1)) > 70
    assert not np.array_equal(*usual.values())


@pytest.mark.parametrize('name', NAMES)
def test_it_changes_the_commands_of_a_controller(name, settings, usual, commands) -> None:
    changed = replaced(settings, {name: other_value(name)})
    try:
        answers = [commands(changed, controller) for controller in CONTROLLERS]
    except InputError:
        # the plan has read it, and finds that this track is too fast or too far out for it
        return
    assert not all(map(np.array_equal, answers, usual.values()))


def other_value(name: str) -> object:
    """What `OTHER` says, or the opposite of a switch, or half of a number."""
    value, described = flatten(USUAL)[name]
    if name in OTHER:
        return OTHER[name]
    return not value if isinstance(value, bool) else max(0.5 * value, described.low)


@pytest.mark.parametrize('name', unused_names(USUAL))
def test_what_would_change_nothing_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=f"'{name}' of mpc_node would have no effect"):
        replaced(USUAL, {name: 1.0}, 'mpc_node')
