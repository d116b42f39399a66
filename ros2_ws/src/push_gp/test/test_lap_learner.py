"""What a run that is cut into laps teaches the next lap."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from push_core.physics import Slider
from push_core.tracks import PIECE
from push_gp.learn import LapCollector, LapLearner, Measured, MeasuredLap, TimedReference
from push_gp.learn.reference_shift import GAIN
from push_gp.models import SmoothCone
from push_gp.server.conversions import learned_of, lesson_message

NOMINAL, BASE, LAP_TIME = Slider(), 'a model', 20.0
TRUTH = replace(NOMINAL, friction_pusher=0.15, support_radius=0.036)


def reference(track: str = 'wave', laps: int = 3) -> TimedReference:
    """A straight way, which the object is taken to follow."""
    time = np.linspace(0.0, laps * LAP_TIME, 1 + round(100 * laps * LAP_TIME))
    return TimedReference(track, 0.08, laps, time, np.zeros((len(time), 2)), 0.0)


def ticks(lap: int, driven: str = BASE, slider: Slider = TRUTH) -> list[Measured]:
    """A lap in which the smooth cone of a slider moves the object under a wavering tip."""
    pose, tip, step = np.zeros(3), None, 8e-4
    cone, found = SmoothCone(slider, step), []
    for number in range(2000):
        place = number / 2000.0
        p_y, beta = 8e-3 * math.sin(25.0 * place), 0.5 * math.pi + 0.5 * math.cos(40.0 * place)
        tip = slider.tip_position(pose, p_y)
        found.append(Measured(LAP_TIME * (lap + place), True, pose.copy(), tip, driven))
        ((dx, dy, turn),) = cone.evaluate(np.array([p_y]), np.array([beta]))[0]
        cos, sin = math.cos(pose[2]), math.sin(pose[2])
        pose += (cos * dx - sin * dy, sin * dx + cos * dy, turn)
    return found


def test_a_run_is_cut_where_the_laps_of_its_reference_end():
    collector, ended = LapCollector(LAP_TIME, 3, 0.08), []
    for lap in range(3):
        ended += [collector.add(each) for each in ticks(lap)[::20]]
    taken = [lap for _, lap in ended if lap is not None]
    # the tick that ends a lap belongs to it; the last lap ends with the run
    assert [len(each.time) for each in taken] == [101, 100]
    last = collector.finish()
    assert last is not None
    assert len(last.time) == 99
    assert collector.finish() is None


def test_a_run_is_cut_into_short_pieces_that_join():
    collector = LapCollector(LAP_TIME, 3, 0.08)
    ended = [collector.add(each)[0] for each in ticks(0)]
    pieces = [each for each in ended if each is not None]
    assert len(pieces) == int(0.999 * LAP_TIME * 0.08 / PIECE)
    for before, after in pairwise(pieces):
        assert before.time[-1] == after.time[0]
        assert 0.08 * (after.time[-1] - after.time[0]) == pytest.approx(PIECE, abs=2e-3)


def pieces_of(slider: Slider) -> list[MeasuredLap]:
    collector = LapCollector(LAP_TIME, 3, 0.08)
    return [piece for piece, _ in map(collector.add, ticks(0, slider=slider)) if piece]


def test_a_few_pieces_identify_the_plant_and_a_change_of_it():
    learner = LapLearner(NOMINAL, BASE)
    learner.begin(reference())
    for piece in pieces_of(TRUTH)[:6]:
        learner.refine(piece)
    assert learner.known.identified.support_radius[0] == pytest.approx(0.036, rel=0.05)
    assert learner.known.identified.friction[0] == pytest.approx(0.15, rel=0.2)
    learner.learn(MeasuredLap.of(ticks(0)))
    for piece in pieces_of(TRUTH)[:8]:
        assert learner.refine(piece) is learner.known
    known = learner.known
    for piece in pieces_of(replace(TRUTH, support_radius=0.055))[:8]:
        learner.refine(piece)
    assert learner.known.identified.support_radius[0] == pytest.approx(0.055, rel=0.05)
    assert learner.known.shift is known.shift


def seen_with_noise(lap: MeasuredLap, random: np.random.Generator) -> MeasuredLap:
    noise = random.normal(size=lap.object_pose.shape) * [5e-4, 5e-4, math.radians(0.5)]
    return replace(lap, object_pose=lap.object_pose + noise)


def test_noisy_pieces_and_laps_identify_the_plant_too():
    learner, random = LapLearner(NOMINAL, BASE), np.random.default_rng(0)
    learner.begin(reference())
    for piece in pieces_of(TRUTH)[:10]:
        learner.refine(seen_with_noise(piece, random))
    assert learner.known.identified.support_radius[0] == pytest.approx(0.036, rel=0.1)
    learned = learner.learn(seen_with_noise(MeasuredLap.of(ticks(0)), random))
    assert learned.identified.support_radius[0] == pytest.approx(0.036, rel=0.03)
    assert learned.identified.friction[0] == pytest.approx(0.15, rel=0.2)
    # the poses are noisy, but no gap and no jump: the whole lap teaches the reference
    noisy = seen_with_noise(MeasuredLap.of(ticks(1, learned.lesson_id(BASE))), random)
    assert learner.learn(noisy).shift[100:-100].any(axis=1).all()


def test_a_piece_with_a_kick_or_a_gap_teaches_nothing():
    for spoil in ('kick', 'gap'):
        learner = LapLearner(NOMINAL, BASE)
        learner.begin(reference())
        piece = pieces_of(TRUTH)[3]
        pose, tracking = piece.object_pose.copy(), piece.tracking.copy()
        if spoil == 'kick':
            pose[30:, 1] += 0.03
        else:
            tracking[30:40] = False
        assert learner.refine(replace(piece, object_pose=pose, tracking=tracking)).model is None


def test_a_lap_identifies_its_plant_and_the_next_one_shifts_the_reference():
    learner = LapLearner(NOMINAL, BASE)
    learner.begin(reference())
    assert learner.known.lesson_id(BASE) == BASE
    first = learner.learn(MeasuredLap.of(ticks(0)))
    assert first.model is not None
    assert not first.shift.any()
    driven = first.lesson_id(BASE)
    assert driven != BASE
    second = learner.learn(MeasuredLap.of(ticks(1, driven)))
    assert second.shift.any()
    assert second.lesson_id(BASE) not in {BASE, driven}
    assert second.is_of(reference())


def test_ticks_that_another_lesson_drove_do_not_shift_the_reference():
    learner = LapLearner(NOMINAL, BASE)
    learner.begin(reference())
    learner.learn(MeasuredLap.of(ticks(0)))
    assert not learner.learn(MeasuredLap.of(ticks(1, 'another lesson'))).shift.any()


def test_where_the_lesson_came_late_the_shift_goes_on_from_the_one_before():
    path = np.array([each.object_pose[:2] for each in ticks(0)])
    followed = replace(
        reference(), position=np.vstack([np.tile(path, (3, 1)), path[:1]]) - [1e-3, 0.0]
    )
    learner = LapLearner(NOMINAL, BASE)
    learner.begin(followed)
    first = learner.learn(MeasuredLap.of(ticks(0)))
    second = learner.learn(MeasuredLap.of(ticks(1, first.lesson_id(BASE))))
    late = ticks(2, first.lesson_id(BASE))[:1000]
    third = learner.learn(MeasuredLap.of(late + ticks(2, second.lesson_id(BASE))[1000:]))
    taught = -GAIN * 1e-3
    for lesson, early, later in ((second, taught, taught), (third, taught, 2.0 * taught)):
        assert np.allclose(lesson.shift[500:900, 0], early, rtol=1e-6)
        assert np.allclose(lesson.shift[1100:1900, 0], later, rtol=1e-6)


def test_another_track_keeps_the_model_and_forgets_the_shift():
    learner = LapLearner(NOMINAL, BASE)
    learner.begin(reference())
    first = learner.learn(MeasuredLap.of(ticks(0)))
    known = learner.learn(MeasuredLap.of(ticks(1, first.lesson_id(BASE))))
    learner.begin(reference())
    assert learner.known is known
    learner.begin(reference('another'))
    assert learner.known.identified is known.identified
    assert not len(learner.known.shift)


def test_a_lesson_outlives_its_message_to_the_last_bit():
    learner = LapLearner(NOMINAL, BASE)
    learner.begin(reference())
    known = learner.learn(MeasuredLap.of(ticks(0)))
    found = learned_of(lesson_message(known, (1, 0), BASE, Time()), NOMINAL, known.model.distance)
    assert found.lesson_id(BASE) == known.lesson_id(BASE)
    assert found.identified.friction == known.identified.friction
    again = LapLearner(NOMINAL, BASE, found)
    again.begin(reference())
    assert again.known is found


@pytest.mark.parametrize('samples', [1, 30])
def test_a_lap_of_few_pushes_teaches_nothing(samples):
    learner = LapLearner(NOMINAL, BASE)
    learner.begin(reference())
    known = learner.learn(MeasuredLap.of(ticks(0)[:samples]))
    assert known.lesson_id(BASE) == BASE
