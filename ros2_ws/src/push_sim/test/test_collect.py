import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from push_core.data.push_csv import read_pushes
from push_core.data.push_set import PushSet, five_push_pattern
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider
from push_sim.collect.collection import Collection, collect_pushes, collected
from push_sim.collect.push_design import PushDesign
from push_sim.collect.short_push import execute_push
from push_sim.commands.collect import main
from push_sim.settings.profiles import profile
from push_sim.worlds.bullet.bullet_world import BulletWorld
from push_sim.worlds.engines import make_coarse_world


def test_the_same_seed_collects_the_same_file(tmp_path: Path) -> None:
    contents = set()
    for name in ('one.csv', 'other.csv'):
        output = tmp_path / name
        assert main(['--pushes', '20', '--seed', '4', '--jobs', '1', '-o', str(output)]) == 0
        contents.add(output.read_bytes())
    assert len(contents) == 1


def test_a_longer_collection_begins_like_a_shorter_one() -> None:
    short, long = collect_pushes(5, seed=1), collect_pushes(10, seed=1)
    assert np.array_equal(long.displacement[:5], short.displacement)
    assert not np.array_equal(collect_pushes(5, seed=2).p_y, short.p_y)


@pytest.fixture(scope='module')
def pushes() -> PushSet:
    return collect_pushes(120, seed=0)


def test_the_pushes_cover_face_and_directions(pushes: PushSet, slider: Slider) -> None:
    design = PushDesign()
    assert pushes.distance == pytest.approx(0.004)
    assert np.all(np.abs(pushes.p_y) <= slider.side / 2.0)
    assert pushes.p_y.std() == pytest.approx(slider.side / 2.0 / math.sqrt(3.0), rel=0.2)
    assert np.abs(pushes.beta - math.pi / 2.0).max() > 0.9 * design.steepest


def test_the_pushes_are_those_of_the_motion_cone_but_for_feet_and_noise(pushes: PushSet) -> None:
    world = profile('irb120').world
    same = Slider(friction_pusher=world.friction_pusher, support_radius=world.support_radius)
    rate, _ = MotionCone(same).evaluate(pushes.p_y, pushes.beta)
    error = np.sqrt(np.mean((pushes.displacement - rate * pushes.distance) ** 2, axis=0))
    assert np.all(error < [0.25e-3, 0.25e-3, math.radians(0.6)])


def test_the_cameras_noise_is_in_the_rows(pushes: PushSet) -> None:
    difference = pushes.displacement - collect_pushes(len(pushes), 0, 'ideal').displacement
    expected = profile('irb120').sensor.position_noise * math.sqrt(2.0)
    # what the noise of the start's heading adds is a hundred times less
    assert np.median(np.abs(difference[:, 0])) == pytest.approx(0.6745 * expected, rel=0.3)


def test_long_steps_do_not_change_a_push(slider: Slider) -> None:
    world = make_coarse_world(profile('ideal').world, slider)
    fine = BulletWorld(profile('ideal').world, slider)
    for p_y, beta in [(0.02, 1.2), (-0.03, 2.0), (0.0, 0.5)]:
        _, after = execute_push(world, slider, PushDesign().timing, p_y, beta)
        fine.reset(np.zeros(3), slider.tip_position(np.zeros(3), p_y))
        fine.advance((0.02 * math.sin(beta), 0.02 * math.cos(beta)), 240)
        assert np.all(np.abs(after.object_pose - fine.object_pose) < [2e-5, 2e-5, 3e-4])


@pytest.mark.parametrize(
    ('arguments', 'named'),
    [
        (['--pushes', '0', '-o', 'x.csv'], '--pushes'),
        (['--pushes', '5', '--seed', '-1', '-o', 'x.csv'], '--seed'),
        (['--pushes', '5', '--speed', '0', '-o', 'x.csv'], 'speed'),
        (['--pushes', '5', '--duration', '0.1234', '-o', 'x.csv'], 'duration'),
        (['--pushes', '5', '-o', 'missing/x.csv'], 'missing'),
        (['--pushes', '5', '-o', '.'], 'is a folder'),
        (['--pushes', '5', '--jobs', '0', '-o', 'x.csv'], '--jobs'),
        (['--pushes', '5', '--sampling', 'grid', '-o', 'x.csv'], '4 or 9'),
        (['--pushes', '4', '--sampling', 'grid', '--duration', '3', '-o', 'x.csv'], '--duration'),
    ],
)
def test_a_wrong_command_is_one_line_and_status_2(
    arguments, named, tmp_path, monkeypatch, capsys
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 2
    error = capsys.readouterr().err
    assert error.count('\n') == 1
    assert named in error
    assert list(tmp_path.iterdir()) == []


def test_a_grid_covers_face_and_directions_evenly(slider: Slider) -> None:
    design = PushDesign()
    pushes = collect_pushes(9, 0, 'ideal', sampling='grid')
    # settling shifts contact and direction by a little
    beta = pushes.beta.reshape(3, 3).mean(axis=0)
    assert np.diff(beta) == pytest.approx([2.0 * design.steepest / 3.0] * 2, abs=0.02)
    p_y = pushes.p_y.reshape(3, 3).mean(axis=1)
    spacing = 2.0 * (slider.side / 2.0 - design.reach) / 3.0
    assert np.diff(p_y) == pytest.approx([spacing] * 2, abs=1e-3)


def test_the_five_of_a_die_come_in_turn(slider: Slider) -> None:
    pushes = collect_pushes(10, 0, 'ideal', sampling='die')
    expected = np.tile(five_push_pattern(slider.side / 2.0), (2, 1))
    assert np.all(np.abs(pushes.inputs - expected) < [0.8e-3, 0.015])
    assert pushes.displacement[:5] == pytest.approx(pushes.displacement[5:], abs=1e-9)


def test_pushes_longer_than_the_face_are_refused(capsys) -> None:
    arguments = ['--pushes', '1', '--speed', '0.5', '--duration', '10', '-o', 'x.csv']
    assert main(arguments) == 2
    assert 'shorter' in capsys.readouterr().err


def test_a_collection_is_written_as_it_was_made(tmp_path: Path) -> None:
    output = tmp_path / 'pushes.csv'
    assert main(['--pushes', '4', '--seed', '7', '-o', str(output)]) == 0
    assert np.array_equal(read_pushes(output).displacement, collect_pushes(4, 7).displacement)


def test_pushes_and_what_the_world_draws_do_not_depend_on_the_number_of_processes() -> None:
    rough = replace(profile('irb120').world, friction_variation=0.2, pressure='random')
    asked = Collection(12, 5, replace(profile('irb120'), world=rough), PushDesign(), 'uniform')
    rows = [np.array(list(collected(asked, jobs))) for jobs in (1, 2)]
    assert np.array_equal(*rows)
