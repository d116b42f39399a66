"""`bench results`: runs the benchmarks and comparisons and publishes their results."""

import argparse
import contextlib
import importlib
import io
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from push_core.common import InputError, Parser, RunError, run_command, write_atomically

from push_bringup.bench import check_positive
from push_bringup.results.commands import COMMANDS
from push_bringup.results.documents import document_paths, quoted, results_page
from push_bringup.results.results_file import provenance, read_results, write_results
from push_bringup.results.sections import SECTIONS, Section

EPILOG = """Example: bench results --measured square_4mm_pushes.csv
A little more than an hour on two cores, its last 20 minutes in real time: nothing else should run
then. It can be interrupted: laps of the same code in runs/bench_results are not pushed again.
results.json is written next to the page after each section; sections that are not run stay as
they are. Then the page and the documents that quote figures are written from it (docs/figures.md).
"""
WORK = Path('runs/bench_results')


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser(
        'Runs the benchmarks of the controllers and writes docs/results.md.', EPILOG
    )
    described.prog = 'bench results'
    described.add_argument('--seeds', type=int, default=5, help='laps of each row (default 5)')
    described.add_argument('--draws', type=int, default=10, help='of each size (default 10)')
    described.add_argument('--runs', type=int, default=3, help='in real time, of each row')
    described.add_argument(
        '--measured',
        type=Path,
        metavar='FILE',
        help='measured pushes, with robot runs next to them',
    )
    names = tuple(section.name for section in SECTIONS)
    described.add_argument(
        '--only',
        nargs='+',
        choices=names,
        metavar='SECTION',
        help=f'run only these of {", ".join(names)}',
    )
    described.add_argument(
        '--write', action='store_true', help='run nothing: only write the documents again'
    )
    described.add_argument('--fresh', action='store_true', help='forget the laps of earlier runs')
    described.add_argument('-o', '--output', type=Path, default=Path('docs/results.md'))
    return described


def work(arguments: argparse.Namespace) -> None:
    """Runs the sections and writes results.json and the documents.

    Raises:
        InputError: a number is out of range, or a file cannot be read or written.
        RunError: a benchmark could not be run.
    """
    for name in ('seeds', 'draws', 'runs'):
        check_positive(f'--{name}', getattr(arguments, name))
    if not arguments.output.parent.is_dir():
        raise InputError(f'there is no folder {arguments.output.parent}')
    if arguments.measured is not None and not arguments.measured.is_file():
        raise InputError(f'{arguments.measured}: no such file')
    path = arguments.output.with_suffix('.json')
    sections = dict(read_results(path)) if path.is_file() or arguments.write else {}
    # before the first section changes results.json
    made = provenance()
    for section in [] if arguments.write else chosen(arguments):
        sys.stderr.write(f'{section.title}\n')
        sections[section.name] = {**result_of(section, arguments), 'made': made}
        write_results(path, sections)
    write_documents(arguments.output)


def write_documents(page: Path) -> None:
    """Writes the results page and the quotations in the other documents from results.json.

    Raises:
        InputError: results.json cannot be read, or a document quotes what it does not hold.
    """
    sections = read_results(page.with_suffix('.json'))
    write_results(page.with_suffix('.json'), sections)
    write_atomically(page, results_page(sections).encode())
    for path in document_paths(page):
        text = path.read_text(encoding='utf-8')
        try:
            written = quoted(text, sections)
        except InputError as error:
            raise InputError(f'{path}: {error}') from error
        if written != text:
            write_atomically(path, written.encode())


def chosen(arguments: argparse.Namespace) -> list[Section]:
    """The sections to run, in the order of the page."""
    names = arguments.only or [
        section.name
        for section in SECTIONS
        if arguments.measured is not None or not section.needs_data
    ]
    sections = [section for section in SECTIONS if section.name in names]
    for section in sections:
        if section.needs_data and arguments.measured is None:
            raise InputError(f'section {section.name} needs --measured FILE')
    return sections


def result_of(section: Section, arguments: argparse.Namespace) -> dict[str, Any]:
    """Runs the command of a section; returns how it is called and what it printed.

    Raises:
        RunError: it printed no result.
    """
    command = COMMANDS[section.command]
    options = options_of(section, arguments)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        module = importlib.import_module(command.module)
        status = module.main([*options, *_work_options(section, arguments), '--json'])
    if status not in (0, 1) or not printed.getvalue():
        raise RunError(f'{command.text} ended with status {status}')
    # the data decide the figures, not where they lie
    words = [
        Path(word).name if '{measured' in template else word
        for word, template in zip(options, section.options, strict=True)
    ]
    return {
        'command': ' '.join((command.text, *words)),
        'results': json.loads(printed.getvalue()),
    }


def options_of(section: Section, arguments: argparse.Namespace) -> list[str]:
    """The options of a section that decide its figures."""
    return [option.format(**vars(arguments)) for option in section.options]


def _work_options(section: Section, arguments: argparse.Namespace) -> list[str]:
    """Where a benchmark keeps what it made already."""
    if section.command in ('timing', 'validate', 'curve'):
        return []
    if section.command == 'realtime':
        return ['-o', str(WORK / 'realtime')]
    models = ['--models', str(WORK / 'models')] if section.command == 'data' else []
    fresh = ['--fresh'] if arguments.fresh else []
    return ['--laps-file', str(WORK / f'{section.name}.jsonl'), *models, *fresh]


if __name__ == '__main__':
    sys.exit(main())
