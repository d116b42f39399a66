"""`ros2 run push_bringup bench WHAT`: the experiments and comparisons of the project."""

import importlib
import sys
from collections.abc import Sequence

from push_core.common import Parser

# what: the module whose `main` runs it, and what it does
BENCHES = {
    'table': ('push_bringup.bench.table', "the paper's rows with both controllers"),
    'data': ('push_bringup.bench.data', 'the error of the GP controller over its training size'),
    'ablation': ('push_bringup.bench.ablation', 'what each part of the controller is worth'),
    'model': ('push_bringup.bench.model', 'our Gaussian processes beside public libraries'),
    'timing': ('push_bringup.bench.timing', 'the quadratic programs of a lap by several solvers'),
    'realtime': ('push_bringup.bench.realtime', "the paper's rows by the clock, and in process"),
    'stopping': ('push_bringup.bench.stopping', 'how long a cell takes to end after Ctrl-C'),
    'results': (
        'push_bringup.results.results',
        'those of the controllers, into docs/results.md',
    ),
}


def main(argv: Sequence[str] | None = None) -> int:
    """Hands over to one benchmark; returns its exit status."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    # its own parser explains the rest of the line
    what = parser().parse_args(arguments[:1]).what
    module = importlib.import_module(BENCHES[what][0])
    return int(module.main(arguments[1:]))


def parser() -> Parser:
    """The first word of the command line."""
    lines = ''.join(f'  {name:<8} {text}\n' for name, (_, text) in BENCHES.items())
    described = Parser(
        'Runs an experiment; `bench WHAT --help` tells its options.',
        f'WHAT is one of\n{lines}',
    )
    described.add_argument('what', choices=BENCHES, metavar='WHAT', help='see below')
    return described


if __name__ == '__main__':
    sys.exit(main())
