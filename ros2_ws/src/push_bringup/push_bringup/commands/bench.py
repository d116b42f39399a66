"""`ros2 run push_bringup bench WHAT`: the experiments and comparisons of the project."""

import importlib
import sys
from collections.abc import Sequence

from push_core.common import Parser

from push_bringup.bench import BENCHES


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one benchmark; returns its exit status."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    # the benchmark has a parser of its own for the rest of the line
    what = parser().parse_args(arguments[:1]).what
    module = importlib.import_module(BENCHES[what][0])
    return int(module.main(arguments[1:]))


def parser() -> Parser:
    """The first word of the command line."""
    lines = ''.join(f'  {name:<8} {text}\n' for name, (_, text) in BENCHES.items())
    described = Parser(
        'Runs a benchmark; `bench WHAT --help` lists its options.',
        f'WHAT is one of\n{lines}',
    )
    described.add_argument('what', choices=BENCHES, metavar='WHAT', help='see below')
    return described


if __name__ == '__main__':
    sys.exit(main())
