"""Writes the figures of results.json into the documents that quote them.

A figure in a sentence is followed by its name, `0.33<!-- figure: NAME -->`, and optionally by a
format (`.1f`); a table is a block between `<!-- table: NAME -->` and `<!-- / -->`.
"""

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from push_core.common import InputError

from push_bringup.bench import BenchResults, experiment_name, markdown_table, time_ranges
from push_bringup.results.commands import COMMANDS
from push_bringup.results.figures import Figure, figures
from push_bringup.results.results_file import Results
from push_bringup.results.sections import SECTIONS, Section

_FIGURE = re.compile(r'[^\s(|>]*(<!-- figure: (\S+)(?: (\S+))? -->)')
_TABLE = re.compile(r'^(<!-- table: (\S+) -->\n).*?^(<!-- / -->)', re.DOTALL | re.MULTILINE)


def document_paths(page: Path) -> list[Path]:
    """The Markdown files in the folder of the results page and in the folder above it."""
    folder = page.resolve().parent
    return sorted({*folder.glob('*.md'), *folder.parent.glob('*.md')} - {page.resolve()})


def quoted(text: str, sections: Results) -> str:
    """A document with the figures and tables of the sections where it quotes them.

    Raises:
        InputError: it quotes a figure or table that the sections do not have.
    """
    numbers = figures(sections)

    def figure(match: re.Match[str]) -> str:
        comment, name, form = match.groups()
        return f'{_formatted(_known(numbers, name, "figure"), form)}{comment}'

    def table(match: re.Match[str]) -> str:
        start, name, end = match.groups()
        return f'{start}\n{_table(name, sections)}\n{end}'

    return _TABLE.sub(table, _FIGURE.sub(figure, text))


def results_page(sections: Results) -> str:
    """The page with every section."""
    made = next(iter(sections.values()))['made']
    parts = [_head(made)]
    parts += [
        _section(section, sections[section.name], made)
        for section in SECTIONS
        if section.name in sections
    ]
    return '\n'.join(parts)


def _formatted(value: Figure, form: str | None) -> str:
    return format(value, form or ('.2f' if isinstance(value, float) else ''))


def _known(names: Mapping[str, Any], name: str, kind: str) -> Any:
    if name not in names:
        raise InputError(f'no {kind} {name!r} in the results; `figures` of results.json lists all')
    return names[name]


def _table(name: str, sections: Results) -> str:
    if name in _SHORT_TABLES:
        section, table = _SHORT_TABLES[name]
        return table(_known(sections, section, 'section')['results'])
    commands = {section.name: section.command for section in SECTIONS}
    table = COMMANDS[_known(commands, name, 'table')].table
    return table(_known(sections, name, 'section')['results'])


def _paper_summary(results: BenchResults) -> str:
    """The paper's rows in the profile irb120, one row for each experiment."""
    rows: dict[str, dict[str, Mapping[str, Any]]] = {}
    for row in results['rows']:
        if row['profile'] == 'irb120':
            rows.setdefault(experiment_name(row), {})[row['controller']] = row
    controllers = list(next(iter(rows.values())))
    heads = [head for name in controllers for head in (name, f'paper, {name}')]
    return markdown_table(
        ('', *heads),
        (
            (name, *(f'{own[each][key]:.2f} mm' for each in controllers for key in _SUMMARY))
            for name, own in rows.items()
        ),
    )


_SUMMARY = ('median_mm', 'paper_mm')
_SHORT_TABLES: Mapping[str, tuple[str, Callable[[BenchResults], str]]] = {
    'paper': ('table', _paper_summary),
    'times': ('real_time', time_ranges),
}


def _head(made: Mapping[str, Any]) -> str:
    return (
        '# Results\n\n'
        'Written from results.json by `ros2 run push_bringup bench results`; below each title is '
        'the command of its table. Errors are distances between the object and the reference '
        'point of the same instant, the mean over a run. In process with the PyBullet plant '
        'unless the section says otherwise. Everything random is drawn from seeds 0, 1, ….\n\n'
        f'{_made(made)}\n'
    )


def _section(section: Section, result: Mapping[str, Any], head: Mapping[str, Any]) -> str:
    own = '' if result['made'] == head else f'{_made(result["made"])}\n\n'
    table = COMMANDS[section.command].table(result['results'])
    return f'## {section.title}\n\n{section.text}\n\n`{result["command"]}`\n\n{own}{table}'


def _made(made: Mapping[str, Any]) -> str:
    libraries = ', '.join(f'{name} {number}' for name, number in made['versions'].items())
    return (
        f'{made["date"]}, commit {made["git_revision"]}, sources {made["source_revision"][:12]}, '
        f'{made["processor"]}, Python {made["python"]}, {libraries}.'
    )
