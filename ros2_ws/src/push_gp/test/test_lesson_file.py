"""What laps have taught, as a file for a run that goes on from there."""

import json
from dataclasses import replace

import numpy as np
import pytest
from push_core.common import InputError
from push_core.physics import Slider
from push_gp.learn import Identified, Learned, read_lesson, write_lesson
from push_gp.models import NOMINAL_DISTANCE, SmoothCone

NOMINAL = Slider()
KNOWN = replace(NOMINAL, friction_pusher=0.1 + 0.2, support_radius=0.0333)
LEARNED = Learned(
    Identified(SmoothCone(KNOWN, NOMINAL_DISTANCE), np.array([[0.01, 0.001], [0.001, 0.02]]), 7),
    'eight',
    0.08,
    np.array([[1e-3 / 3.0, 0.0], [-1e-4, 2e-4]]),
)


def test_it_is_read_as_it_was_written_to_the_last_bit(tmp_path):
    write_lesson(tmp_path / 'lesson.json', LEARNED)
    found = read_lesson(tmp_path / 'lesson.json', NOMINAL)
    assert found.lesson_id('') == LEARNED.lesson_id('')
    assert (found.track, found.speed) == ('eight', 0.08)
    np.testing.assert_array_equal(found.identified.covariance, LEARNED.identified.covariance)


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('friction', -1.0),
        ('support_radius_m', 'wide'),
        ('covariance', [1.0]),
        ('shift_m', [[1.0, 2.0, 3.0]]),
        ('shift_m', [[float('nan'), 0.0]]),
        ('pushes', None),
    ],
)
def test_a_file_that_cannot_be_is_refused(tmp_path, name, value):
    path = tmp_path / 'lesson.json'
    write_lesson(path, LEARNED)
    path.write_text(json.dumps({**json.loads(path.read_text()), name: value}))
    with pytest.raises(InputError, match='is not what laps have taught'):
        read_lesson(path, NOMINAL)


@pytest.mark.parametrize('text', ['', '[]', '{}'])
def test_what_is_no_lesson_is_refused(tmp_path, text):
    path = tmp_path / 'lesson.json'
    path.write_text(text)
    with pytest.raises(InputError, match='is not what laps have taught'):
        read_lesson(path, NOMINAL)
