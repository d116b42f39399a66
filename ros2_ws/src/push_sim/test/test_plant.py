import pickle
import subprocess
import sys
from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest
from push_core.common.errors import InputError
from push_core.common.settings import replaced
from push_core.geometry.frames import rotation, to_body
from push_core.physics.slider import Slider
from push_sim.plant.perturbation import Perturbation
from push_sim.plant.plant import Plant
from push_sim.settings.plant_settings import PerturbationKind
from push_sim.settings.profiles import PROFILES, profile

POSE = np.array([0.1, -0.2, 0.3])
FORWARD = rotation(POSE[2]) @ [0.05, 0.0]


def run(plant: Plant, start, weave, periods: int = 100, seed: int = 3) -> np.ndarray:
    """Everything that the sensor showed (periods, 6)."""
    plant.reset(*start, seed)
    shown = []
    for tick in range(periods):
        plant.command(weave(tick), plant.time)
        seen = plant.step_until_seen()
        shown.append([seen.time, *seen.object_pose, *seen.tip_position])
    return np.array(shown)


@pytest.mark.parametrize('name', PROFILES)
def test_a_reset_gives_the_same_trajectory_bit_for_bit_whatever_came_before(
    name, slider, start, weave
) -> None:
    plant = Plant(profile(name), slider)
    first = run(plant, start, weave)
    random = np.random.default_rng(0)
    for _ in range(5):
        pose = random.normal(size=3)
        plant.reset(pose, slider.tip_position(pose, 0.03), 9)
        for _ in range(20):
            plant.command(random.normal(0.0, 0.1, 2), plant.time)
            plant.step()
    plant.perturb(Perturbation(PerturbationKind.IMPULSE, 0.3, 1.0))
    assert np.array_equal(run(plant, start, weave), first)


def commanded(plant: Plant, weave, first: int, last: int) -> list[np.ndarray | None]:
    """All that the sensor showed in some periods of a weaving push."""
    shown = []
    for tick in range(first, last):
        plant.command(weave(tick), plant.time)
        seen = plant.step()
        shown.append(seen and np.array([seen.time, *seen.object_pose, *seen.tip_position]))
    return shown


def same(one: list[np.ndarray | None], other: list[np.ndarray | None]) -> bool:
    return all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))


EVEN_TABLE = {'world.friction_variation': 0.0, 'world.friction_anisotropy': 1.0}


@pytest.mark.parametrize('name', PROFILES)
def test_a_restored_plant_goes_on_to_the_last_bit_in_the_same_object_or_another(
    name, engine, slider, start, weave
) -> None:
    changes = {
        'world.engine': engine,
        **(EVEN_TABLE if engine == 'quasi_static' else {}),
        'perturbation.kind': 'impulse',
        'perturbation.time': 0.3,
    }
    settings = replaced(profile(name), changes)
    plant, other = Plant(settings, slider), Plant(settings, slider)
    plant.reset(*start, 3)
    before = commanded(plant, weave, 0, 23)
    snapshot = pickle.loads(pickle.dumps(plant.snapshot()))
    after = commanded(plant, weave, 23, 60)
    for restored in (plant, other):
        restored.reset(np.zeros(3), np.array([-0.06, 0.0]), 8)
        commanded(restored, weave, 40, 50)
        restored.restore(snapshot)
        assert same(commanded(restored, weave, 23, 60), after)
        assert [d.kind for d in restored.take_perturbations()] == [PerturbationKind.IMPULSE]
    plant.reset(*start, 3)
    assert same(commanded(plant, weave, 0, 60), before + after)


def test_a_snapshot_of_other_settings_is_refused(slider, start) -> None:
    plant, other = Plant(profile('ideal'), slider), Plant(profile('irb120'), slider)
    plant.reset(*start, 0)
    with pytest.raises(InputError, match='same settings'):
        other.restore(plant.snapshot())


def test_another_process_gives_the_same_trajectory(slider) -> None:
    program = (
        'import numpy as np; from push_core.physics.slider import Slider;'
        'from push_sim.plant.plant import Plant;'
        'from push_sim.settings.profiles import profile;'
        'plant = Plant(profile("irb120"), Slider()); pose = np.array([0.1, -0.2, 0.3]);'
        'plant.reset(pose, Slider().tip_position(pose, 0.01), 3);'
        '[(plant.command(np.array([0.08, 0.02]), plant.time), plant.step()) for _ in range(80)];'
        'print(*map(float.hex, map(float, plant.object_pose)))'
    )
    outputs = {
        subprocess.run([sys.executable, '-c', program], capture_output=True, check=True).stdout
        for _ in range(2)
    }
    assert len(outputs) == 1


def test_another_seed_draws_other_noise_around_the_same_motion(irb120, start, weave) -> None:
    one, other = run(irb120, start, weave, seed=1), run(irb120, start, weave, seed=2)
    difference = other[:, 1:4] - one[:, 1:4]
    scale = np.array([PROFILES['irb120'].sensor.position_noise * 2**0.5] * 2)
    assert difference[:, :2].std(axis=0) == pytest.approx(scale, rel=0.3)
    assert np.array_equal(one[:, 4:], other[:, 4:])


def test_the_irb120_lags_by_dead_time_and_lag_within_a_millisecond(irb120) -> None:
    settings = PROFILES['irb120'].actuator
    away = np.array([-1.0, 0.0])
    irb120.reset(POSE, away, 0)
    for _ in range(100):
        irb120.command(np.array([0.05, 0.0]), irb120.time)
        irb120.step()
    delay = 1.0 - (irb120.tip_position - away)[0] / 0.05
    assert delay == pytest.approx(settings.dead_time + settings.lag, abs=1e-3)


def test_nothing_moves_during_the_dead_time(irb120, start) -> None:
    irb120.reset(*start, 0)
    for tick in range(8):
        irb120.command(FORWARD, irb120.time)
        irb120.step()
        moved = np.hypot(*(irb120.tip_position - start[1]))
        assert (moved > 1e-12) == (tick >= 6)


def test_a_command_acts_from_its_arrival_within_the_period(ideal) -> None:
    away = np.array([-1.0, 0.0])
    ideal.reset(POSE, away, 0)
    ideal.command(np.array([0.05, 0.0]), ideal.time + 0.006)
    ideal.step()
    assert (ideal.tip_position - away)[0] == pytest.approx(0.05 * 0.004, abs=1e-5)


@pytest.mark.parametrize('name', PROFILES)
def test_the_tip_rests_within_a_quarter_second_after_the_last_command(name, slider) -> None:
    plant = Plant(profile(name), slider)
    plant.reset(POSE, np.array([-1.0, 0.0]), 0)
    for _ in range(40):
        plant.command(np.array([0.25, 0.0]), plant.time)
        plant.step()
    assert plant.tip_velocity[0] > 0.2
    for _ in range(24):
        plant.step()
    assert np.array_equal(plant.tip_velocity, [0.0, 0.0])
    rest = plant.tip_position
    plant.step()
    np.testing.assert_allclose(plant.tip_position, rest, atol=1e-12)


@pytest.mark.parametrize('latency', [0.0, 0.003, 0.01, 0.025])
def test_what_is_shown_was_exposed_one_latency_ago(latency: float, slider, start) -> None:
    settings = replaced(profile('ideal'), {'sensor.latency': latency, 'world.substep': 0.001})
    plant = Plant(settings, slider)
    assert plant.reset(*start, 0).time == pytest.approx(Plant.START - latency)
    for _ in range(20):
        plant.command(FORWARD, plant.time)
        seen = plant.step()
        assert plant.time - seen.time == pytest.approx(latency, abs=1e-9)
    expected = start[1] + FORWARD * (seen.time - Plant.START)
    np.testing.assert_allclose(seen.tip_position, expected, atol=1e-4)


def test_jitter_adds_up_to_itself_to_the_age_of_a_picture(slider, start) -> None:
    changes = {'sensor.latency': 0.005, 'sensor.jitter': 0.008}
    plant = Plant(replaced(profile('ideal'), changes), slider)
    plant.reset(*start, 0)
    ages, places = [], []
    for _ in range(400):
        plant.command(FORWARD, plant.time)
        seen = plant.step()
        ages.append(plant.time - seen.time)
        places.append(np.hypot(*(seen.tip_position - start[1])) - 0.05 * (seen.time - plant.START))
    assert min(ages) == pytest.approx(0.005, abs=1e-9)
    assert max(ages) == pytest.approx(0.013, abs=1e-9)
    assert np.mean(ages) == pytest.approx(0.009, abs=3e-4)
    # the stamp tells the true time of the exposure
    np.testing.assert_allclose(places, 0.0, atol=1e-4)


def test_a_webcam_shows_thirty_pictures_a_second_40_ms_old_give_or_take_ten(slider, start) -> None:
    plant = Plant(profile('webcam'), slider)
    seen = [plant.reset(*start, 0)]
    ages, errors = [], []
    for _ in range(3000):
        picture = plant.step()
        if picture is not None:
            seen.append(picture)
            ages.append(plant.time - picture.time)
            errors.append(picture.object_pose - picture.truth.object_pose)
    assert len(ages) == pytest.approx(0.98 * 900, abs=15)
    assert (min(ages), max(ages)) == pytest.approx((0.03, 0.05), abs=1e-9)
    assert np.mean(ages) == pytest.approx(0.04, abs=1e-3)
    assert np.std(errors, axis=0) == pytest.approx([1e-3, 1e-3, np.radians(1.0)], rel=0.1)
    assert (np.diff([picture.time for picture in seen]) > 0.0).all()


def test_what_stands_for_a_missing_picture_has_a_stamp_of_its_own(slider, start) -> None:
    plant = Plant(profile('webcam'), slider)
    times = [plant.reset(*start, 0).time]
    for _ in range(1000):
        times.append((plant.step() or plant.without_picture()).time)
    assert len({round(1e9 * time) for time in times}) == len(times)
    assert not plant.without_picture().shows_object


def test_a_lost_picture_is_none_and_the_next_one_is_found(slider, start) -> None:
    plant = Plant(replaced(profile('ideal'), {'sensor.dropout': 0.5}), slider)
    assert plant.reset(*start, 0) is not None
    seen = [plant.step() for _ in range(200)]
    assert 0.3 < seen.count(None) / 200 < 0.7
    before = plant.time
    assert plant.step_until_seen().time == plant.time > before


def test_a_normal_perturbation_leaves_a_gap_of_30_mm(ideal, slider, start) -> None:
    ideal.reset(*start, 0)
    applied = ideal.perturb(Perturbation(PerturbationKind.NORMAL, 0.03))
    assert slider.gap(ideal.object_pose, ideal.tip_position) == pytest.approx(0.03, abs=1e-9)
    np.testing.assert_allclose(applied.direction, rotation(POSE[2])[:, 0])


@pytest.mark.parametrize('magnitude', [0.02, -0.02])
def test_a_tangential_perturbation_shifts_the_contact_along_the_face(
    ideal, slider, start, magnitude
) -> None:
    ideal.reset(*start, 0)
    applied = ideal.perturb(Perturbation(PerturbationKind.TANGENTIAL, magnitude))
    np.testing.assert_array_equal(ideal.object_pose, start[0])
    np.testing.assert_allclose(applied.direction, rotation(POSE[2])[:, 1])
    p_y = slider.contact_offset(ideal.object_pose, ideal.tip_position)
    assert p_y == pytest.approx(0.01 + magnitude, abs=1e-9)
    assert slider.gap(ideal.object_pose, ideal.tip_position) == pytest.approx(0.0, abs=1e-9)


def test_an_impulse_slides_the_object_until_friction_has_stopped_it(ideal, slider) -> None:
    ideal.reset(POSE, np.array([-1.0, 0.0]), 0)
    ideal.perturb(Perturbation(PerturbationKind.IMPULSE, 0.2, angle=1.0))
    for _ in range(30):
        ideal.step()
    speed = 0.2 / slider.mass
    travel = speed**2 / (2.0 * profile('ideal').world.friction_ground * 9.81)
    moved = ideal.object_pose[:2] - POSE[:2]
    assert np.hypot(*moved) == pytest.approx(travel, rel=0.05)
    assert np.arctan2(moved[1], moved[0]) == pytest.approx(1.0, abs=1e-3)


def test_a_perturbation_that_makes_no_sense_is_refused() -> None:
    for kind, magnitude in [
        (PerturbationKind.NORMAL, -0.01),
        (PerturbationKind.IMPULSE, 2.0),
        (PerturbationKind.NORMAL, np.nan),
    ]:
        with pytest.raises(InputError, match=kind.name.lower()):
            Perturbation(kind, magnitude)


def test_a_scheduled_perturbation_waits_for_its_time_after_the_first_motion(
    slider: Slider, start
) -> None:
    changes = {'perturbation.kind': 'normal', 'perturbation.time': 0.1}
    plant = Plant(replaced(profile('ideal'), changes), slider)
    plant.reset(*start, 0)
    times = []
    for tick in range(40):
        plant.command(FORWARD if tick >= 5 else np.zeros(2), plant.time)
        plant.step()
        times += [applied.time for applied in plant.take_perturbations()]
    assert times == [pytest.approx(Plant.START + 0.05 + 0.1)]


def test_a_perturbation_at_time_zero_is_there_from_the_start(slider: Slider, start) -> None:
    plant = Plant(replaced(profile('ideal'), {'perturbation.kind': 'normal'}), slider)
    seen = plant.reset(*start, 0)
    assert to_body(seen.object_pose, start[1])[0] == pytest.approx(slider.tip_x - 0.03)
    assert [applied.kind for applied in plant.take_perturbations()] == [PerturbationKind.NORMAL]


def test_a_reset_refuses_what_is_no_state(ideal, start) -> None:
    with pytest.raises(InputError, match='finite'):
        ideal.reset(np.array([np.nan, 0.0, 0.0]), start[1], 0)
    with pytest.raises(InputError, match='seed'):
        ideal.reset(*start, -1)
    with pytest.raises(InputError, match='object pose'):
        ideal.reset(start[1], start[1], 0)


OFFSETS = [(0.004, -0.002, 0.05), (0.001, 0.0, 0.0)]


@pytest.mark.parametrize('offset', OFFSETS)
def test_a_reset_places_the_object_with_the_start_offset(
    engine, slider: Slider, start, offset
) -> None:
    names = ('start_offset.x', 'start_offset.y', 'start_offset.theta')
    changes = {'world.engine': engine, **dict(zip(names, offset, strict=True))}
    plant = Plant(replaced(profile('ideal'), changes), slider)
    seen = plant.reset(*start, 0)
    moved = [*to_body(start[0], plant.object_pose[:2]), plant.object_pose[2] - start[0][2]]
    assert moved == pytest.approx(offset, abs=1e-9)
    # the cameras see where it is, not where it was requested
    np.testing.assert_allclose(seen.object_pose, plant.object_pose, atol=1e-6)
    np.testing.assert_allclose(plant.tip_position, start[1], atol=1e-12)


def test_a_start_offset_towards_the_tip_ends_in_contact(engine, slider: Slider, start) -> None:
    changes = {'world.engine': engine, 'start_offset.x': -0.003}
    plant = Plant(replaced(profile('ideal'), changes), slider)
    plant.reset(*start, 0)
    assert slider.gap(plant.object_pose, plant.tip_position) == pytest.approx(0.0, abs=1e-9)
    assert slider.contact_offset(plant.object_pose, plant.tip_position) == pytest.approx(0.01)


def test_a_command_that_is_not_finite_counts_as_none(ideal, start) -> None:
    ideal.reset(*start, 0)
    for _ in range(10):
        ideal.command(np.array([np.nan, 0.0]), ideal.time)
        ideal.step()
    assert ideal.braking
    np.testing.assert_allclose(ideal.tip_position, start[1], atol=1e-12)


def test_the_latency_must_fit_the_substep(slider: Slider) -> None:
    settings = profile('irb120')
    sensor = replace(settings.sensor, latency=0.0033)
    with pytest.raises(InputError, match=r'sensor\.latency'):
        Plant(replace(settings, sensor=sensor), slider)


@pytest.mark.parametrize('variation', [0.0, 0.2])
def test_changed_friction_counts_as_if_the_plant_had_been_made_with_it(
    variation: float, engine, slider, start, weave
) -> None:
    if variation and engine == 'quasi_static':
        pytest.skip('the quasi-static engine has an even table')
    even = {'world.engine': engine, 'world.friction_variation': variation}
    settings = replaced(profile('ideal'), even)
    rough = replaced(settings, {'world.friction_ground': 0.6, 'world.friction_pusher': 0.02})
    with closing(Plant(settings, slider)) as plant, closing(Plant(rough, slider)) as other:
        before = run(plant, start, weave)
        plant.change(rough)
        after = run(plant, start, weave)
        assert np.array_equal(after, run(other, start, weave))
        assert not np.array_equal(after, before)


def test_friction_changes_in_the_middle_of_a_push(slider, start, weave) -> None:
    settings = profile('ideal')
    with closing(Plant(settings, slider)) as plant:
        plant.reset(*start, 3)
        commanded(plant, weave, 0, 50)
        kept = plant.snapshot()
        usual = commanded(plant, weave, 50, 80)
        plant.restore(kept)
        plant.change(replaced(settings, {'world.friction_pusher': 0.0}))
        slippery = commanded(plant, weave, 50, 80)
    assert not same(usual, slippery)


def test_a_plant_refuses_to_change_what_it_was_made_of(slider) -> None:
    settings = profile('ideal')
    with closing(Plant(settings, slider)) as plant:
        for name, value in (('world.mass_error', 0.1), ('actuator.lag', 0.2)):
            with pytest.raises(InputError, match='cannot change'):
                plant.change(replaced(settings, {name: value}))
