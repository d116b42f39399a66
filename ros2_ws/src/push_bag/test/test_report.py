"""The report is one file that loads nothing else and shows the score."""

import json
import math
import re

import numpy as np
import pytest
from plotly.offline import get_plotlyjs_version
from push_bag.commands.score import main
from push_bag.report.animation import animation_data
from push_bag.report.learning_figure import MAGNIFIED, lap_figures, shift_figure
from push_bag.report.report import REPORT_FILE, report_html, write_results
from push_bag.report.reported_run import reported_runs
from push_bag.report.timing_figure import timing_figures
from push_bag.run.horizons import Horizons
from push_bag.run.run_reader import read_run
from push_bag.score.score import score_series
from push_report.deferred_figure import drawing_library


@pytest.fixture(scope='module')
def page(perfect):
    write_results(perfect)
    return (perfect / REPORT_FILE).read_text()


def own_markup(page):
    """The page without the drawing library, which contains addresses that it does not load."""
    return re.sub(r'<script>/\*\*.*?</script>', '', page, count=1, flags=re.DOTALL)


def test_the_page_loads_nothing(page):
    assert len(own_markup(page)) < 500_000 < len(page)
    assert not re.search(r'<(script|img|link|iframe)[^>]*(src|href)="(?!data:)', page)
    assert 'http' not in own_markup(page)


def test_the_page_is_at_most_6_megabytes(page):
    assert len(page.encode()) < 6e6


def test_the_page_draws_the_lap_the_time_and_the_timing(page):
    stored = r'<script type="application/json" id="([\w-]+)-figure">(.*?)</script>'
    figures = re.findall(stored, page)
    assert {'lap', 'time', 'timing-1'} <= set(re.findall(r'<div id="([\w-]+)"', page))
    assert all(json.loads(figure)['data'] for _, figure in figures)
    assert [name for name, _ in figures] == [
        *('lap', 'animation', 'time'),
        *('timing-1', 'timing-2', 'timing-3'),
    ]


def test_the_library_in_the_page_is_of_the_version_that_writes_the_figures():
    assert f'plotly.js (basic - minified) v{get_plotlyjs_version()}\n' in drawing_library()[:100]


def test_the_page_shows_verdict_score_and_facts(page):
    for words in ('completed', '0.00 mm', '0 of ', 'messages lost', 'irb120', '/object_pose'):
        assert words in own_markup(page)


def test_a_run_that_never_tracked_has_a_report_too(record):
    run = read_run(record(modes=lambda _tick: 1))
    assert 'not completed' in report_html([(run, score_series(run))])


def test_a_panel_without_measurements_says_so_in_its_own_place(record):
    run = read_run(record(facts={'mode': 'inprocess'}))
    *_, answers = timing_figures(reported_runs([(run, score_series(run))]))
    (words,) = [each for each in answers.layout.annotations if each.text == 'not measured']
    assert words.xref == 'x domain'
    assert len(answers.data) == 1


def test_facts_cannot_inject_markup(perfect):
    run = read_run(perfect)
    run.facts['note'] = '<script>alert(1)</script>'
    assert '<script>alert' not in report_html([(run, score_series(run))])


def test_score_writes_the_report_to_the_named_file(perfect, tmp_path, capsys):
    assert main([str(perfect), '--html', str(tmp_path / 'page.html')]) == 0
    assert capsys.readouterr().out.startswith('completed')
    assert (tmp_path / 'page.html').stat().st_size > 1_000_000


def test_perturbations_and_contact_losses_are_marked(record, perfect):
    marked = read_run(
        record(perturbed_at=0.5, gap=lambda time: 0.002 if 0.5 < time < 0.7 else 0.0)
    )
    unmarked = read_run(perfect)
    page = report_html([(marked, score_series(marked))])
    for name in ('no contact', 'perturbation'):
        assert f'"name":"{name}"' in page
    assert '"name":"no contact"' not in report_html([(unmarked, score_series(unmarked))])


def test_errors_of_laps_what_was_identified_and_the_shift_are_drawn(record):
    lessons = ((-9.0, 0, 0.3, 0.0), (0.8, 200, 0.2, 1e-3))
    run = read_run(record(laps=2, lessons=lessons))
    scored = [(run, score_series(run))]
    (reported,) = reported_runs(scored)
    errors, friction, radius = (figure.data[0] for figure in lap_figures([reported]))
    assert list(errors.x) == [1, 2]
    assert (list(friction.x), list(friction.y)) == ([2], [0.2])
    assert radius.error_y.array[0] == pytest.approx(1.2)
    reference, shifted = shift_figure(reported).data
    moved = np.hypot(shifted.x - reference.x, shifted.y - reference.y)
    assert np.allclose(moved, MAGNIFIED * 1e3 * math.hypot(1e-3, 1e-3), rtol=1e-3)
    assert 'Lap after lap' in report_html(scored)


def test_a_run_of_one_lap_has_no_figures_of_laps(perfect):
    run = read_run(perfect)
    assert lap_figures(reported_runs([(run, score_series(run))])) == []


def test_several_runs_share_one_page(record, perfect):
    runs = [read_run(perfect), read_run(record(perturbed_at=0.5))]
    page = report_html([(run, score_series(run)) for run in runs])
    assert '<h1>2 runs</h1>' in page
    assert page.count('"name":"2: ') >= 3
    animated = json.loads(re.search(r'const ANIMATION = (.*);\n', page).group(1))
    assert [len(run['x']) for run in animated['runs']] == [
        len(run['time']) for run in animated['runs']
    ]


def test_the_animation_shows_where_the_object_was(perfect):
    run = read_run(perfect)
    (shown,) = reported_runs([(run, score_series(run))])
    (frames,) = json.loads(animation_data([shown]))['runs']
    at = np.interp(frames['time'], shown.tracking.reference_time, shown.tracking.pose[:, 0] * 1e3)
    np.testing.assert_allclose(frames['x'], at, atol=0.6)
    assert np.max(np.diff(frames['time'])) <= 0.05


def test_the_animation_shows_what_was_planned(perfect, paths):
    run = read_run(perfect)
    (shown,) = reported_runs([(run, score_series(run))])
    (frames,) = json.loads(animation_data([shown]))['runs']
    width = frames['horizon_points']
    for time, x, y in zip(
        frames['time'],
        np.reshape(frames['horizon_x'], (-1, width)),
        np.reshape(frames['horizon_y'], (-1, width)),
        strict=True,
    ):
        # the latest plan is at most 50 ms old
        ahead = np.array([paths['circle'](time + 0.35 - age)[:2] for age in (0.0, 0.06)]) * 1e3
        low, high = ahead.min(axis=0) - 0.2, ahead.max(axis=0) + 0.2
        assert np.all((low <= [x[-1], y[-1]]) & ([x[-1], y[-1]] <= high))


def test_an_old_plan_is_not_shown(record):
    hesitant = read_run(record(missing={'horizon': range(60, 200)}))
    horizons = Horizons.of(hesitant.horizons)
    shown = horizons.at(hesitant.object.stamp)
    last = horizons.stamp[-1]
    old = hesitant.object.stamp > last + 200_000_000
    assert np.isnan(shown[old]).all()
    assert old.any()
    fresh = (hesitant.object.stamp >= horizons.stamp[0]) & ~old
    assert np.isfinite(shown[fresh]).all()
