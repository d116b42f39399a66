"""The published figures: results.json, and what quotes it."""

import importlib
import json
import sys
from pathlib import Path

import pytest
from push_bringup.bench import paper_table
from push_bringup.bench.benches import BENCHES
from push_bringup.results import results as bench_results
from push_bringup.results.commands import COMMANDS
from push_bringup.results.documents import document_paths, quoted, results_page
from push_bringup.results.figures import figures
from push_bringup.results.results_file import read_results
from push_bringup.results.sections import SECTIONS
from push_core.common.errors import InputError

DOCS = Path(__file__).resolve().parents[4] / 'docs'
ROW = {
    'track': 'eight',
    'speed_m_s': 0.08,
    'perturbation': 'none',
    'controller': 'gp',
    'profile': 'irb120',
    'seeds': 5,
    'completed': 5,
    'median_mm': 0.3254,
    'mean_mm': 0.3254,
    'spread_mm': 0.01,
    'paper_mm': 8.5,
}
RESULTS = {
    'table': {'command': 'bench table', 'made': {'date': '2026-11-28'}, 'results': {'rows': [ROW]}}
}


@pytest.fixture(scope='module')
def published():
    return read_results(DOCS / 'results.json')


def test_the_results_page_is_that_of_the_results_file(published) -> None:
    assert (DOCS / 'results.md').read_text() == results_page(published)


def test_the_figures_to_quote_are_those_of_the_sections(published) -> None:
    assert json.loads((DOCS / 'results.json').read_text())['figures'] == figures(published)
    assert set(published) == {section.name for section in SECTIONS}


@pytest.mark.parametrize('path', document_paths(DOCS / 'results.md'), ids=lambda path: path.name)
def test_what_a_document_quotes_is_in_the_results_file(path: Path, published) -> None:
    text = path.read_text()
    assert text == quoted(text, published), 'run `bench results --write`'


def test_a_quoted_figure_is_replaced_in_its_format() -> None:
    text = '9.99<!-- figure: eight_80_gp --> mm of (?<!-- figure: table_laps -->) laps'
    assert quoted(text, RESULTS) == text.replace('9.99', '0.33').replace('?', '5')
    short = 'about 7<!-- figure: eight_80_gp .1f -->'
    assert quoted(short, RESULTS) == short.replace('7', '0.3')
    date = '2026<!-- figure: table_date -->'
    assert quoted(date, RESULTS) == date.replace('2026', '2026-11-28')


def test_a_quoted_table_is_replaced() -> None:
    text = 'before\n<!-- table: paper -->\nanything\n\n<!-- / -->\nafter'
    row = '| eight 80 mm/s | 0.33 mm | 8.50 mm |'
    head = '|  | gp | paper, gp |\n|---|---|---|'
    expected = f'before\n<!-- table: paper -->\n\n{head}\n{row}\n\n<!-- / -->\nafter'
    assert quoted(text, RESULTS) == expected
    assert quoted(expected, RESULTS) == expected


@pytest.mark.parametrize(
    'quotation', ['1<!-- figure: nine_80_gp -->', '<!-- table: nine -->\n<!-- / -->']
)
def test_an_unknown_quotation_is_named(quotation: str) -> None:
    with pytest.raises(InputError, match='nine'):
        quoted(quotation, RESULTS)


def test_every_section_is_a_command_that_its_benchmark_takes(tmp_path: Path) -> None:
    given = ['--measured', str(tmp_path / 'pushes.csv'), '--fresh']
    arguments = bench_results.parser().parse_args(given)
    unpublished = {'results', 'model', 'stopping'}
    assert {section.command for section in SECTIONS} >= {*BENCHES} - unpublished
    for section in SECTIONS:
        module = importlib.import_module(COMMANDS[section.command].module)
        module.parser().parse_args(bench_results.options_of(section, arguments))


def test_only_some_sections_are_run_and_the_others_stay(tmp_path: Path, monkeypatch) -> None:
    asked: list[list[str]] = []

    def table(options: list[str]) -> int:
        asked.append(options)
        sys.stdout.write(json.dumps({'rows': [ROW]}))
        return 1

    monkeypatch.setattr(paper_table, 'main', table)
    (tmp_path / 'docs').mkdir()
    page, guide = tmp_path / 'docs' / 'results.md', tmp_path / 'guide.md'
    guide.write_text('?<!-- figure: eight_80_gp -->')
    assert bench_results.main(['--only', 'table', '-o', str(page)]) == 0
    first = read_results(page.with_suffix('.json'))['table']
    assert bench_results.main(['--only', 'harsh', '--seeds', '2', '-o', str(page)]) == 0
    results = read_results(page.with_suffix('.json'))
    assert results['table'] == first
    assert results['harsh']['command'] == (
        'ros2 run push_bringup bench table --profile harsh --controllers gp --seeds 2'
    )
    assert results['harsh']['made']['source_revision']
    assert '--laps-file' in asked[0]
    assert '0.33' in guide.read_text()
    assert page.read_text().count('| irb120 | eight |') == 2


def test_a_benchmark_that_could_not_run_leaves_no_results(monkeypatch, tmp_path, capsys) -> None:
    monkeypatch.setattr(paper_table, 'main', lambda _options: 2)
    page = tmp_path / 'results.md'
    assert bench_results.main(['-o', str(page)]) == 1
    assert 'bench table ended with status 2' in capsys.readouterr().err
    assert not page.exists()
    assert not page.with_suffix('.json').exists()


def test_writing_without_results_is_refused_in_one_line(tmp_path, capsys) -> None:
    assert bench_results.main(['--write', '-o', str(tmp_path / 'results.md')]) == 2
    assert capsys.readouterr().err.count('\n') == 1
