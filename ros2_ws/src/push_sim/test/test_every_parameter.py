"""Every parameter of sim_node that is listed changes what the plant does, or is refused."""

import numpy as np
import pytest
from push_core.common import flatten, replaced, unused_names
from push_core.geometry import Array
from push_sim.node.node_settings import NodeSettings, node_settings
from push_sim.node.sim_node import main
from push_sim.plant.plant import Plant

OF_THE_NODE = {
    'profile',
    'mode',
}  # test_settings.py and test_sim_node.py hold them to their effect
SETTINGS = replaced(
    node_settings('harsh'),
    {
        'perturbation.kind': 'impulse',
        'perturbation.time': 0.1,
    },
)
EVEN = {'world.friction_variation': 0.0, 'world.friction_anisotropy': 1.0}
OTHER = {
    'world.engine': ('quasi_static', EVEN),
    'world.substep': (0.002, {}),
    'world.pressure': ('rim', {}),
    # it ends before this many where the residual allows
    'world.solver_iterations': (10, {'world.solver_residual': 0.0}),
    'world.solver_residual': (1e-4, {}),
    'sensor.dropout': (0.5, {}),
    'sensor.freeze_rate': (5.0, {}),
    'command_loss': (0.5, {}),
    'limits.workspace_x': (0.05, {'limits.deceleration': 0.1}),
    'limits.workspace_y': (0.05, {'limits.deceleration': 0.1}),
    'limits.deceleration': (0.1, {'limits.workspace_x': 0.1}),
    'limits.reaction_time': (0.5, {'limits.workspace_x': 0.1}),
    'limits.dead_band': (0.01, {}),
    'perturbation.kind': ('normal', {}),
    'perturbation.magnitude': (0.1, {}),
}
OWN = {'limits.acceleration': 'actuator.acceleration_limit'}
NAMES = sorted(
    name for name in set(flatten(SETTINGS)) - OF_THE_NODE if not name.startswith('realtime.')
)


def motion(settings: NodeSettings) -> Array:
    """Times, poses and tips while the tip pushes, races, creeps aside and is left alone."""
    plant = Plant(settings, settings.slider)
    start = settings.start
    seen = [plant.reset(start.object_pose, start.tip_position(settings.slider), settings.seed)]
    for period in range(95):
        if period < 40:
            v_n = 0.05 if period < 20 else 0.4
            plant.command(np.array([v_n, 0.02]), plant.time)
        elif period < 60:
            plant.command(np.array([0.0, 0.008]), plant.time)
        elif period < 75:
            plant.command(np.array([0.0, 0.25]), plant.time)
        seen.append(plant.step_until_seen())
    plant.close()
    return np.array([[each.time, *each.object_pose, *each.tip_position] for each in seen])


@pytest.fixture(scope='module')
def usual() -> Array:
    return motion(SETTINGS)


def other_value(name: str) -> tuple[object, dict[str, object]]:
    """Half of a number, or what `OTHER` says; and the settings that it needs to matter."""
    value, described = flatten(SETTINGS)[name]
    if name in OTHER:
        return OTHER[name]
    if isinstance(value, int):
        return value + 1, {}
    return max(0.5 * value, described.low) if value else min(0.01, described.high), {}


@pytest.mark.parametrize('name', NAMES)
def test_it_changes_the_motion(name: str, usual: Array) -> None:
    value, needs = other_value(name)
    base = motion(replaced(SETTINGS, needs)) if needs else usual
    changed = motion(replaced(SETTINGS, {**needs, name: value}))
    assert not np.array_equal(changed, base)


@pytest.mark.parametrize('name', unused_names(SETTINGS))
def test_what_would_change_nothing_is_refused_with_the_parameter_to_use(name: str, capfd) -> None:
    assert main(['--ros-args', '-p', f'{name}:=0.1']) == 2
    lines = [line for line in capfd.readouterr().err.splitlines() if name in line]
    assert len(lines) == 1
    own = OWN.get(name) or name.replace('slider', 'world')
    assert f"parameter '{name}' of sim_node would have no effect" in lines[0]
    assert f' {own}' in lines[0]
    assert own in NAMES
