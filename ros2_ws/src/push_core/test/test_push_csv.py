import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from push_core.common.errors import InputError
from push_core.data.push_csv import COLUMNS, read_pushes, write_pushes
from push_core.data.push_set import PushSet

HEADER = ','.join(COLUMNS)
GOOD_ROW = '0.01,1.5,0.003,0.0001,-0.02,0.004'


@pytest.fixture
def pushes() -> PushSet:
    generator = np.random.default_rng(1)
    return PushSet(
        generator.uniform(-0.045, 0.045, 20),
        generator.uniform(0.1, 3.0, 20),
        generator.normal(0, 1e-3, (20, 3)),
        0.004,
        {'subset_7': np.arange(20) < 7},
    )


def refusal(folder: Path, text: str | bytes) -> str:
    path = folder / 'pushes.csv'
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(InputError) as caught:
        read_pushes(path)
    message = str(caught.value)
    assert str(path) in message
    assert '\n' not in message
    return message


def test_a_written_set_reads_back_bit_for_bit(pushes: PushSet, tmp_path: Path) -> None:
    write_pushes(tmp_path / 'a.csv', pushes)
    again = read_pushes(tmp_path / 'a.csv')
    assert again.sha256() == pushes.sha256()
    assert np.array_equal(again.displacement, pushes.displacement)
    assert np.array_equal(again.subsets['subset_7'], pushes.subsets['subset_7'])


def test_columns_may_come_in_any_order_with_blank_lines_and_a_byte_order_mark(
    tmp_path: Path,
) -> None:
    names = ','.join(reversed(COLUMNS))
    row = ','.join(reversed(GOOD_ROW.split(',')))
    (tmp_path / 'a.csv').write_text(f'\ufeff{names}\n\n{row}\n', encoding='utf-8')
    pushes = read_pushes(tmp_path / 'a.csv')
    assert pushes.p_y == [0.01]
    assert pushes.displacement.tolist() == [[0.003, 0.0001, -0.02]]


@pytest.mark.parametrize(
    ('row', 'fault'),
    [
        ('0.01,1.5,0.003,0.0001,-0.02', 'has 5 values, not 6'),
        ('0.01,1.5,0.003,0.0001,-0.02,0.004,1', 'has 7 values'),
        ('0.01,1.5,,0.0001,-0.02,0.004', "dx_m is '', not a number"),
        ('0.01,nan,0.003,0.0001,-0.02,0.004', 'beta_rad is nan'),
        ('0.01,1.5,inf,0.0001,-0.02,0.004', 'dx_m is inf'),
        ('0.06,1.5,0.003,0.0001,-0.02,0.004', 'p_y is 0.06 m'),
        ('0.01,3.2,0.003,0.0001,-0.02,0.004', 'beta is 3.2 rad'),
        ('0.01,0,0.003,0.0001,-0.02,0.004', 'beta is 0 rad'),
        ('0.01,1.5,3.1,0.1,-0.02,0.004', 'no push moves the object by 3.1 m'),
        ('0.01,1.5,0.003,0.0001,-0.02,0.005', 'one set holds pushes of one distance'),
    ],
)
def test_a_bad_row_is_refused_with_its_line(row: str, fault: str, tmp_path: Path) -> None:
    message = refusal(tmp_path, f'{HEADER}\n{GOOD_ROW}\n\n{row}\n{GOOD_ROW}\n')
    assert 'line 4' in message
    assert fault in message


@pytest.mark.parametrize(
    ('text', 'fault'),
    [
        ('', 'is empty'),
        ('\n\n', 'is empty'),
        (HEADER + '\n', 'holds no pushes'),
        (
            'x0_m,y0_m\n1,2\n',
            'column p_y_m, beta_rad, dx_m, dy_m, dtheta_rad, distance_m is missing',
        ),
        (f'{GOOD_ROW}\n', 'names no columns; the first line must be p_y_m,beta_rad'),
        (f'{HEADER}\n{GOOD_ROW.replace("0.004", "4_0e-4")}\n', "'4_0e-4', not a number"),
        (f'{HEADER}\n34.6,1.5,0.003,0.0001,-0.02,0.004\n', 'p_y_m looks like millimetres'),
        (f'{HEADER}\n0.01,87,0.003,0.0001,-0.02,0.004\n', 'beta_rad looks like degrees'),
        (f'{HEADER}\n0.01,-0.4,0.003,0.0001,-0.02,0.004\n', 'from the inward normal'),
        (f'{HEADER}\n0.01,1.5,3.1,0.1,-0.02,0.004\n', 'dx_m and dy_m look like millimetres'),
        (f'{HEADER}\n0.01,1.5,0.003,0.0001,-20,0.004\n', 'dtheta_rad looks like degrees'),
        (f'{HEADER}\n0.01,1.5,0.003,0.0001,-0.02,4\n', 'distance_m looks like millimetres'),
        (f'{HEADER},dx_m\n{GOOD_ROW},1\n', 'column dx_m is there twice'),
        (f'{HEADER},subset_5\n{GOOD_ROW},2\n', 'subset_5 is 2, must be 0 or 1'),
        (f'{HEADER}\n0.01,1.5,0.003,0.0001,-0.02,0\n', 'must be between 0 and 1 m'),
        (b'PK\x03\x04\xff\xfe\x00', 'is not a CSV text file'),
    ],
)
def test_a_bad_file_is_refused_with_its_fault(
    text: str | bytes, fault: str, tmp_path: Path
) -> None:
    assert fault in refusal(tmp_path, text)


def with_semicolons(text: str) -> str:
    return text.replace(',', ';')


FORMS = {
    'comment': f'# pushes of 2026\n{HEADER}\n{GOOD_ROW}\n',
    'names behind a hash': f'# {HEADER}\n{GOOD_ROW}\n',
    'semicolons': with_semicolons(f'{HEADER}\n{GOOD_ROW}\n'),
    'decimal comma': with_semicolons(f'{HEADER}\n{GOOD_ROW}\n').replace('.', ','),
    'tabs': f'{HEADER}\n{GOOD_ROW}\n'.replace(',', '\t'),
    'row index': f',{HEADER}\n0,{GOOD_ROW}\n',
    'further column': f'{HEADER},note\n{GOOD_ROW},first try\n',
    'capitals': f'{HEADER.upper()}\n{GOOD_ROW}\n',
    'line of blanks': f'{HEADER}\n{GOOD_ROW}\n   \n',
    'separator at the end': f'{HEADER},\n{GOOD_ROW},\n',
    'quotes': ','.join(f'"{name}"' for name in HEADER.split(',')) + f'\n{GOOD_ROW}\n',
    'blanks': f'{HEADER}\n{GOOD_ROW}\n'.replace(',', ' , '),
    'line feeds of a Mac': f'{HEADER}\r{GOOD_ROW}\r',
}


@pytest.mark.parametrize('form', FORMS)
def test_what_other_programs_write_is_read(form: str, tmp_path: Path) -> None:
    (tmp_path / 'a.csv').write_text(FORMS[form], encoding='utf-8', newline='')
    (tmp_path / 'plain.csv').write_text(f'{HEADER}\n{GOOD_ROW}\n', encoding='utf-8')
    read, plain = read_pushes(tmp_path / 'a.csv'), read_pushes(tmp_path / 'plain.csv')
    assert read.sha256() == plain.sha256()


def test_a_missing_file_and_a_folder_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r'none.csv: No such file'):
        read_pushes(tmp_path / 'none.csv')
    with pytest.raises(InputError, match='cannot read'):
        read_pushes(tmp_path)


def test_writing_into_a_missing_folder_is_refused(pushes: PushSet, tmp_path: Path) -> None:
    with pytest.raises(InputError, match='cannot write'):
        write_pushes(tmp_path / 'none' / 'a.csv', pushes)


def test_a_write_that_fails_leaves_the_old_file_and_nothing_else(
    pushes: PushSet, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / 'a.csv').write_text('old')

    def disk_full(_descriptor: int) -> None:
        raise OSError(28, 'No space left on device')

    monkeypatch.setattr(os, 'fsync', disk_full)
    with pytest.raises(InputError, match='No space left'):
        write_pushes(tmp_path / 'a.csv', pushes)
    assert [path.name for path in tmp_path.iterdir()] == ['a.csv']
    assert (tmp_path / 'a.csv').read_text() == 'old'


def test_the_measured_pushes_read_whole() -> None:
    folder = Path(os.environ.get('PUSH_DATA_DIR', _beside_the_project() / 'shared' / 'data'))
    if not folder.is_dir():
        pytest.skip(f'no measured pushes in {folder}')
    pushes = read_pushes(folder / 'square_4mm_pushes.csv')
    assert len(pushes) == 2987
    assert pushes.distance == 0.004
    assert pushes.subsets['subset_500'].sum() == 500


def _beside_the_project() -> Path:
    return Path(__file__).resolve().parents[5]


def test_a_set_refuses_values_that_are_no_pushes() -> None:
    with pytest.raises(InputError, match='push 1: p_y = nan'):
        PushSet(np.array([0.0, np.nan]), np.ones(2), np.zeros((2, 3)), 0.004)
    with pytest.raises(InputError, match='n x 3'):
        PushSet(np.zeros(2), np.ones(2), np.zeros((3, 2)), 0.004)


def test_a_set_cannot_be_changed_behind_its_back(pushes: PushSet) -> None:
    with pytest.raises(ValueError, match='read-only'):
        pushes.p_y[0] = 0.0


def test_only_pushes_of_the_same_distance_join(pushes: PushSet) -> None:
    other = PushSet(pushes.p_y, pushes.beta, pushes.displacement, 0.005)
    assert len(pushes.joined(pushes)) == 40
    with pytest.raises(InputError, match='do not join'):
        pushes.joined(other)


def test_no_file_whatever_is_read_as_anything_but_pushes(
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    path = tmp_path_factory.mktemp('fuzz') / 'pushes.csv'
    good = f'{HEADER}\n{GOOD_ROW}\n{GOOD_ROW}\n'.encode()
    span = st.integers(0, len(good))
    patches = st.tuples(span, span, st.binary(max_size=6))

    @settings(max_examples=200)
    @given(st.binary(max_size=60) | patches)
    def check(change: bytes | tuple[int, int, bytes]) -> None:
        if isinstance(change, bytes):
            path.write_bytes(change)
        else:
            first, last, new = change
            path.write_bytes(good[:first] + new + good[last:])
        try:
            pushes = read_pushes(path)
        except InputError as error:
            assert str(path) in str(error)
        else:
            assert np.isfinite(pushes.displacement).all()
            assert len(pushes) >= 1

    check()
