import math
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from push_core.common.errors import InputError
from push_core.data.long_push_csv import COLUMNS, holds_long_pushes, read_long_pushes
from push_core.data.long_pushes import FACE_MARGIN, LongPushes
from push_core.data.push_csv import COLUMNS as SHORT_COLUMNS
from push_core.physics.slider import Slider

START = np.array([0.2, -0.1, 0.3])
END = np.array([0.24, -0.08, 0.5])
Write = Callable[..., Path]


def pushed(face: int, end_offset: float = 0.01) -> list[float]:
    """One row: a push on the face that is x = -a/2 after as many quarter turns of the frame."""
    slider, turn = Slider(), np.array([0.0, 0.0, face * math.pi / 2.0])
    tip_start = slider.tip_position(START, 0.02)
    tip_end = slider.tip_position(END, end_offset)
    return [*(START - turn), *(END - turn), *tip_start, *tip_end]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    def write(*rows: list[float]) -> Path:
        lines = [','.join(COLUMNS), *(','.join(map(repr, map(float, row))) for row in rows)]
        (tmp_path / 'long.csv').write_text('\n'.join(lines) + '\n', encoding='utf-8')
        return tmp_path / 'long.csv'

    return write


@pytest.fixture
def measured() -> LongPushes:
    beside_the_project = Path(__file__).resolve().parents[5] / 'shared' / 'data'
    folder = Path(os.environ.get('PUSH_DATA_DIR', beside_the_project))
    if not folder.is_dir():
        pytest.skip(f'no measured pushes in {folder}; PUSH_DATA_DIR names their folder')
    return read_long_pushes(folder / 'square_50mm_pushes_abs_10mms.csv')


def test_whichever_face_was_pushed_becomes_the_one_of_the_conventions(write: Write) -> None:
    pushes = read_long_pushes(write(*(pushed(face) for face in range(4))))
    assert np.allclose(np.cos(pushes.start[:, 2] - START[2]), 1.0)
    assert np.allclose(np.cos(pushes.end[:, 2] - END[2]), 1.0)
    slider = Slider()
    for pose, tip in zip(pushes.start, pushes.tip_start, strict=True):
        assert slider.contact_offset(pose, tip) == pytest.approx(0.02)
        assert slider.gap(pose, tip) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(('offset', 'on_face'), [(0.0, True), (-0.0459, True), (0.0461, False)])
def test_a_push_stays_on_the_face_if_its_tip_ends_there(
    write: Write, offset: float, on_face: bool
) -> None:
    assert FACE_MARGIN == 1e-3
    assert read_long_pushes(write(pushed(0, offset))).on_face.tolist() == [on_face]


def test_errors_are_those_of_the_end_pose_whatever_turns_the_heading_counts(
    write: Write,
) -> None:
    pushes = read_long_pushes(write(pushed(0), pushed(0, 0.06)))
    gaps = np.array([[3e-3, 4e-3, 2.0 * math.pi + 0.1], [0.0, 0.0, -0.2]])
    errors = pushes.errors(pushes.end + gaps)
    block = errors.of(pushes.on_face)
    assert block['n'] == 1
    assert block['mean_mm'] == pytest.approx(5.0)
    assert block['mean_deg'] == pytest.approx(math.degrees(0.1))
    assert errors.of(np.full(2, True))['mean_mm'] == pytest.approx(2.5)
    assert errors.of(np.full(2, False)) == {'n': 0, 'mean_mm': None, 'mean_deg': None}


@pytest.mark.parametrize(
    ('column', 'value', 'fault'),
    [
        ('x0_m', 335.0, 'line 3: x0_m is 335; metres and radians are expected'),
        ('theta1_rad', math.nan, 'line 3: theta1_rad is nan, not a finite number'),
        ('tip_x0_m', 0.0, 'line 3: the tip starts .* away from the face'),
    ],
)
def test_a_row_that_is_no_push_is_named(
    write: Write, column: str, value: float, fault: str
) -> None:
    wrong = pushed(0)
    wrong[COLUMNS.index(column)] = value
    with pytest.raises(InputError, match=fault):
        read_long_pushes(write(pushed(0), wrong))


def test_a_file_tells_by_its_columns_what_pushes_it_holds(write: Write, tmp_path: Path) -> None:
    assert holds_long_pushes(write(pushed(0)))
    (tmp_path / 'short.csv').write_text(','.join(SHORT_COLUMNS), encoding='utf-8')
    assert not holds_long_pushes(tmp_path / 'short.csv')
    with pytest.raises(InputError, match=r'column x0_m, .* is missing'):
        read_long_pushes(tmp_path / 'short.csv')


def test_of_the_measured_pushes_297_stay_on_the_face(measured: LongPushes) -> None:
    assert len(measured) == 396
    assert measured.on_face.sum() == 297
    assert np.allclose(measured.distance, 0.05, atol=2e-4)
