import math

import numpy as np
import pytest
from push_core.common.errors import InputError
from push_core.tracks.built_in import by_name
from push_core.tracks.track_csv import MAX_KNOTS, read_track

POINTS = np.array([[0.0, 0.0], [0.1, 0.02], [0.2, 0.0], [0.3, -0.02], [0.4, 0.0]])
GOOD = '0.0,0.0\n0.1,0.0\n0.2,0.1\n0.3,0.1\n'


def refusal(path) -> str:
    with pytest.raises(InputError) as caught:
        read_track(path)
    message = str(caught.value)
    assert str(path) in message
    assert '\n' not in message
    return message


def test_a_circle_of_points_is_a_circle(circle_csv) -> None:
    track = by_name(str(circle_csv))
    assert (track.name, track.closed) == ('circle', True)
    assert track.length == pytest.approx(2.0 * math.pi * 0.2, rel=1e-5)
    x, y, _, curvature = track.at(np.linspace(0.0, track.length, 1000))
    assert np.hypot(x, y) == pytest.approx(np.full(1000, 0.2), abs=1e-7)
    assert curvature == pytest.approx(np.full(1000, 5.0), rel=2e-3)


def test_an_open_track_begins_and_ends_at_its_points(write_track) -> None:
    track = read_track(write_track(POINTS))
    x, y, _, _ = track.at(np.array([0.0, track.length]))
    assert not track.closed
    assert (x.tolist(), y.tolist()) == (pytest.approx([0.0, 0.4]), pytest.approx([0.0, 0.0]))


@pytest.mark.parametrize(
    'heading', ['', 'x,y\n', ' x [m], y [m]\n', 'x_m,y_m\n', '\ufeffx,y\n', '\n\n']
)
def test_a_heading_a_byte_order_mark_and_blank_lines_do_no_harm(write_track, heading) -> None:
    with_heading = read_track(write_track(POINTS, heading))
    assert with_heading.length == read_track(write_track(POINTS)).length


def test_points_that_repeat_do_no_harm(write_track) -> None:
    repeated = read_track(write_track(np.repeat(POINTS, 3, axis=0)))
    assert repeated.length == read_track(write_track(POINTS)).length


@pytest.mark.parametrize('aside', [0.0, 1e-15, 5e-5])
def test_points_at_the_same_place_do_not_bend_the_track(write_track, aside) -> None:
    straight = np.array([[0.0, 0.0], [0.1, 0.0], [0.1, aside], [0.2, 0.0], [0.3, 0.0], [0.4, 0.0]])
    track = read_track(write_track(straight))
    _, y, _, _ = track.at(np.linspace(0.0, track.length, 200))
    assert (track.length, np.abs(y).max()) == (pytest.approx(0.4, abs=1e-6), pytest.approx(0.0))


def test_a_closed_track_stays_closed_where_its_last_points_lie_close(write_track) -> None:
    angle = np.append(np.linspace(0.0, 2.0 * math.pi, 40), 2.0 * math.pi)
    angle[-2] -= 1e-4
    circle = 0.2 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    circle[-1] = circle[0]
    assert read_track(write_track(circle)).closed


@pytest.mark.parametrize('heading', ['y,x\n', 'x_mm,y_mm\n', 'time,x\n'])
def test_a_heading_of_something_else_is_refused(write_track, heading) -> None:
    assert 'is not x,y or x_m,y_m' in refusal(write_track(POINTS, heading))


def test_a_track_too_short_to_be_pushed_is_refused(write_track) -> None:
    assert 'too short to be pushed' in refusal(write_track(0.01 * POINTS))


def test_very_many_points_are_thinned_by_arc_length(write_track) -> None:
    # crowded at one end, as a drawing tool would leave them
    angle = 0.5 * math.pi * np.linspace(0.0, 1.0, 5 * MAX_KNOTS) ** 3
    track = read_track(write_track(0.3 * np.stack([np.sin(angle), np.cos(angle)], axis=-1)))
    assert track.length == pytest.approx(0.5 * math.pi * 0.3, rel=1e-5)
    x, y, _, _ = track.at(np.linspace(0.0, track.length, 500))
    assert np.hypot(x, y) == pytest.approx(np.full(500, 0.3), abs=1e-6)


@pytest.mark.parametrize(
    ('row', 'fault'),
    [
        ('0.4', 'expected two numbers x,y in metres'),
        ('0.4,0.1,0.2', 'expected two numbers x,y in metres'),
        ('0.4;0.1', 'expected two numbers x,y in metres'),
        ('0.4,', 'expected two numbers x,y in metres'),
        ('x,y', 'expected two numbers x,y in metres'),
        ('nan,0.1', 'x and y must be finite'),
        ('0.4,inf', 'x and y must be finite'),
        ('1e20,0.1', 'beyond 1e+06 m'),
    ],
)
def test_a_bad_row_is_refused_with_its_file_and_line(tmp_path, row, fault) -> None:
    path = tmp_path / 'bad.csv'
    path.write_text(f'x,y\n{GOOD}\n{row}\n')
    message = refusal(path)
    assert message.startswith(f'{path}:7: ')
    assert fault in message


def test_not_a_number_in_the_first_line_is_no_heading(tmp_path) -> None:
    path = tmp_path / 'bad.csv'
    path.write_text(f'nan,0.0\n{GOOD}')
    assert refusal(path).startswith(f'{path}:1: x and y must be finite')


@pytest.mark.parametrize(('content', 'found'), [('', 0), ('x,y\n', 0), ('0,0\n1,1\n1,1\n', 2)])
def test_too_few_points_are_refused(tmp_path, content, found) -> None:
    path = tmp_path / 'few.csv'
    path.write_text(content)
    assert f'at least 4 points that are 0.1 mm apart, found {found}' in refusal(path)


def test_a_missing_file_a_folder_and_a_binary_file_are_refused(tmp_path) -> None:
    assert 'No such file' in refusal(tmp_path / 'none.csv')
    assert 'Is a directory' in refusal(tmp_path)
    (tmp_path / 'image.csv').write_bytes(b'\x89PNG\xff\xfe')
    assert 'not a CSV text file' in refusal(tmp_path / 'image.csv')


OVAL = np.array([[0.3 * math.cos(a), 0.2 * math.sin(a)] for a in np.linspace(0.0, math.tau, 60)])


def lines(points, between=',', form='{:.6f}') -> str:
    return ''.join(between.join(form.format(value) for value in point) + '\n' for point in points)


@pytest.mark.parametrize(
    'text',
    [
        '# oval\n' + lines(OVAL),
        '# x_m,y_m\n' + lines(OVAL),
        '# x_m,y_m,w_tr_right_m,w_tr_left_m\n' + lines(np.hstack([OVAL, 0.1 + 0.0 * OVAL])),
        '# s_m; x_m; y_m\n' + lines(np.column_stack([np.arange(60.0), OVAL]), '; '),
        lines(OVAL, ';'),
        lines(OVAL, ';').replace('.', ','),
        lines(OVAL, '\t'),
        'X\tY\n' + lines(OVAL, '\t'),
        lines(OVAL, ' ', '{:.18e}'),
        '# x y\n' + lines(OVAL, '  '),
        '"x","y"\n' + lines(OVAL, ',', '"{:.6f}"'),
        ',x,y\n' + lines(np.column_stack([np.arange(60.0), OVAL])),
        't,x,y,theta\n' + lines(np.column_stack([np.arange(60.0), OVAL, np.arange(60.0)])),
        'x,y,comment\n' + lines(OVAL).replace('\n', ',a corner\n'),
        '# made by hand, x to the right\n\nx,y\n' + lines(OVAL),
        lines(OVAL).replace('\n', ',\n'),
        lines(OVAL).replace('\n', '\r\n'),
        lines(OVAL[:-1]) + '# the end\n' + lines(OVAL[-1:]),
    ],
)
def test_a_track_is_read_as_other_programs_write_it(text, tmp_path, capsys) -> None:
    path = tmp_path / 'oval.csv'
    path.write_text(text, newline='')
    track = read_track(path)
    (tmp_path / 'plain.csv').write_text(lines(OVAL))
    assert track.length == pytest.approx(read_track(tmp_path / 'plain.csv').length, abs=1e-5)
    assert track.closed
    assert capsys.readouterr().err == ''


@pytest.mark.parametrize(
    ('text', 'fault'),
    [
        ('x_mm,y_mm\n' + lines(1e3 * OVAL), 'divide millimetres by 1000'),
        ('lat,lon\n' + lines(OVAL), "the heading 'lat,lon' is not x,y"),
        ('x,y,x\n' + lines(np.hstack([OVAL, OVAL[:, :1]])), 'is not x,y'),
        (lines(np.column_stack([np.arange(60.0), OVAL])), 'counts the rows; name the columns'),
        (lines(OVAL[:, :1]), 'expected two numbers'),
        ('x,y\n' + lines(OVAL, ';'), 'expected two numbers'),
        ('{"x": [0, 1]}\n', 'not x,y'),
    ],
)
def test_what_is_not_clear_is_refused_with_what_to_change(text, fault, tmp_path) -> None:
    path = tmp_path / 'oval.csv'
    path.write_text(text)
    assert fault in refusal(path)


@pytest.mark.parametrize('gap', [1e-5, 0.6e-3, 1.9e-3])
def test_a_track_that_all_but_ends_where_it_begins_is_closed_with_a_word(
    gap, write_track, capsys
) -> None:
    points = OVAL.copy()
    points[-1] += [0.0, gap]
    track = read_track(write_track(points))
    assert track.closed
    assert track.length == pytest.approx(read_track(write_track(OVAL)).length, rel=1e-6)
    assert 'mm from its start, so it is closed' in capsys.readouterr().err


@pytest.mark.parametrize('points', [OVAL[:-1], OVAL[:-1] * 0.1, POINTS])
def test_one_that_ends_farther_away_stays_open(points, write_track) -> None:
    assert not read_track(write_track(points)).closed


def test_a_curve_through_the_corners_of_a_polygon_says_how_far_it_leaves_the_sides(
    write_track, capsys
) -> None:
    square = np.array([[0.0, 0.0], [0.3, 0.0], [0.3, 0.3], [0.0, 0.3], [0.0, 0.0]])
    track = read_track(write_track(square))
    x, y, _, _ = track.at(np.linspace(0.0, track.length, 2000))
    aside = max(x.max() - 0.3, y.max() - 0.3, -x.min(), -y.min())
    told = capsys.readouterr().err
    assert f'up to {1e3 * aside:.0f} mm off the straight lines between them' in told
    read_track(write_track(OVAL))
    assert capsys.readouterr().err == ''
