"""`bench results`: everything into one Markdown file, each table with its command."""

import argparse
import contextlib
import importlib
import io
import platform
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

from push_core.common import InputError, Parser, RunError, run_command, write_atomically

from push_bringup.bench.options import check_positive
from push_bringup.setup import git_revision, processor, versions

EPILOG = """Example: bench results --measured square_4mm_pushes.csv -o docs/results.md
About an hour on two cores, its last 20 minutes by the clock: nothing else should run then. It can
be interrupted: laps that are in runs/bench_results are not pushed again (--fresh forgets them).
"""
WORK = 'runs/bench_results'
MODELS = ('--models', f'{WORK}/models')


@dataclass(frozen=True)
class Section:
    """One command and what a reader should know before its table.

    Attributes:
        title: of the section.
        text: before the table.
        bench: word after `bench`.
        options: of the command.
    """

    title: str
    text: str
    bench: str
    options: tuple[str, ...]


def main(argv: Sequence[str] | None = None) -> int:
    """Runs everything."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser('Runs every benchmark of the controllers and writes one file.', EPILOG)
    described.prog = 'bench results'
    described.add_argument('--seeds', type=int, default=5, help='laps of each row (default 5)')
    described.add_argument('--draws', type=int, default=10, help='of each size (default 10)')
    described.add_argument('--runs', type=int, default=3, help='by the clock, of each row')
    described.add_argument(
        '--measured', type=Path, metavar='FILE', help='measured pushes, to learn from as well'
    )
    described.add_argument('--fresh', action='store_true', help='forget the laps of earlier runs')
    described.add_argument('-o', '--output', type=Path, default=Path('docs/results.md'))
    return described


def work(arguments: argparse.Namespace) -> None:
    """Runs all sections and writes the file, whole or not at all.

    Raises:
        InputError: a number is out of range, or the file cannot be written.
        RunError: a benchmark could not be run.
    """
    for name in ('seeds', 'draws', 'runs'):
        check_positive(f'--{name}', getattr(arguments, name))
    if not arguments.output.parent.is_dir():
        raise InputError(f'there is no folder {arguments.output.parent}')
    if arguments.measured is not None and not arguments.measured.is_file():
        raise InputError(f'{arguments.measured}: no such file')
    parts = [head()]
    for section in sections(arguments):
        sys.stderr.write(f'{section.title}\n')
        parts.append(told(section))
    write_atomically(arguments.output, '\n'.join(parts).encode())


def head() -> str:
    """What all figures have in common."""
    libraries = ', '.join(f'{name} {number}' for name, number in versions().items())
    return (
        '# Results\n\n'
        'Made by `ros2 run push_bringup bench results`; below each title stands the command of '
        'its table. Errors are distances between the object and the reference point of the same '
        'instant, the mean over a run. In process with the PyBullet plant, but for the last '
        'section. Everything is drawn from seeds 0, 1, ….\n\n'
        f'{datetime.now(timezone.utc):%Y-%m-%d}, revision {git_revision()}, {processor()}, '
        f'Python {platform.python_version()}, {libraries}.\n'
    )


def sections(arguments: argparse.Namespace) -> list[Section]:
    """All of them, in the order of the file."""
    return [
        *_rows(arguments),
        *_measured(arguments),
        *_sizes(arguments),
        *_parts(arguments),
        *_clock(arguments),
    ]


def _laps(name: str, arguments: argparse.Namespace) -> tuple[str, ...]:
    """Options that name a section's own file of laps."""
    fresh = ('--fresh',) if arguments.fresh else ()
    return ('--laps-file', f'{WORK}/{name}.jsonl', *fresh)


def _rows(arguments: argparse.Namespace) -> list[Section]:
    return [
        Section(
            "The paper's table",
            'Beside the errors of the real robot in the paper. `irb120` has the measured lag of '
            'the robot and the noise of its cameras, `ideal` neither. One set of parameters for '
            'all rows.',
            'table',
            (
                *('--profile', 'irb120', 'ideal', '--seeds', str(arguments.seeds)),
                *_laps('table', arguments),
            ),
        ),
        Section(
            'A harsh cell',
            'The same rows with the profile `harsh`: an uneven table, six times the noise, '
            'latency, jitter, lost pictures and commands (docs/worlds.md).',
            'table',
            (
                *('--profile', 'harsh', '--controllers', 'gp', '--seeds', str(arguments.seeds)),
                *_laps('harsh', arguments),
            ),
        ),
    ]


def _measured(arguments: argparse.Namespace) -> list[Section]:
    if arguments.measured is None:
        return []
    return [
        Section(
            'Learned from the pushes of the real cell',
            'The same lap with models of measured pushes: what was learned of one plant, tried on '
            'another.',
            'data',
            (
                *('--data', str(arguments.measured), '--points', '10', '50', '200'),
                *('--draws', str(arguments.draws), *MODELS, *_laps('measured', arguments)),
            ),
        ),
    ]


def _sizes(arguments: argparse.Namespace) -> list[Section]:
    return [
        Section(
            'Training size',
            'The 8-track at 80 mm/s, profile `irb120`, with models of random nested draws from '
            '10 000 simulated pushes and of the five of a die. The paper: about 14 mm with 10 '
            'pushes, unstable with fewer at random, 9 mm with the die in four laps of five, '
            'level with the analytical controller from about 200 on.',
            'data',
            ('--draws', str(arguments.draws), *MODELS, *_laps('data', arguments)),
        ),
    ]


def _parts(arguments: argparse.Namespace) -> list[Section]:
    return [
        Section(
            'What each part is worth',
            'The GP controller with parts off, profile `irb120`. `preset paper` has the literal '
            'weights, horizon and plan of the paper; control.md says why they do not track. The '
            'last column is the rms change of the commanded velocity from tick to tick, on the '
            'eight at 80 mm/s.',
            'ablation',
            ('--seeds', '1', *_laps('ablation', arguments)),
        ),
        Section(
            'The solver: GP controller',
            'All programs of a lap with kicks, putting the numbers in and solving, CPU time of '
            'one thread.',
            'timing',
            ('--controller', 'gp'),
        ),
        Section(
            'The solver: Family of Modes',
            'Three programs a tick; their times add up.',
            'timing',
            ('--controller', 'analytical'),
        ),
    ]


def _clock(arguments: argparse.Namespace) -> list[Section]:
    return [
        Section(
            'By the clock',
            'The node graph over DDS, recorded, beside the same laps in process; medians. Where a '
            'host takes the cores away commands are late, and after 0.5 s without a pose the '
            'lap ends.',
            'realtime',
            ('--runs', str(arguments.runs), '-o', f'{WORK}/realtime'),
        ),
    ]


def told(section: Section) -> str:
    """The section as Markdown, with what its command printed."""
    bench = importlib.import_module(f'push_bringup.bench.{section.bench}')
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        status = bench.main(list(section.options))
    if status not in (0, 1) or not printed.getvalue():
        raise RunError(f'bench {section.bench} ended with status {status}')
    command = ' '.join(('ros2 run push_bringup bench', section.bench, *_public(section.options)))
    return f'## {section.title}\n\n{section.text}\n\n`{command}`\n\n{printed.getvalue()}'


def _public(options: Sequence[str]) -> list[str]:
    """Options that decide the figures; where files lie does not."""
    own = iter(options)
    kept = []
    for option in own:
        if option in ('--laps-file', '--models', '-o'):
            next(own)
        elif option != '--fresh':
            kept.append(Path(option).name if option.endswith('.csv') else option)
    return kept


if __name__ == '__main__':
    sys.exit(main())
