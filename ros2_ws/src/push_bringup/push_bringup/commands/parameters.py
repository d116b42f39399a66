"""`ros2 run push_bringup parameters`: every parameter of every node, as a Markdown page."""

import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from push_core.common import Described, Parser, flatten, run_command
from push_mpc import settings as mpc
from push_sim import node as sim

from push_bringup.setup import node_defaults

_CHANGEABLE = {'sim_node': sim.is_changeable, 'mpc_node': mpc.is_changeable}

HEAD = """# Parameters

Every parameter of every node, with its default in the `irb120` profile. Set one with
`cell -p NAME:=VALUE` (or `NODE.NAME:=VALUE` where several nodes share the name), in a parameter
file, or with `--ros-args -p NAME:=VALUE` on a node. They are read at the start, which an
unknown name or a value out of range fails; those with a * may change during a run. Made by
`ros2 run push_bringup parameters`.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Prints the page."""
    return run_command(Parser('Prints the parameters of all nodes as Markdown.'), _work, argv)


def page() -> str:
    """The page, with one table per node."""
    return ''.join([HEAD, *(_section(*node) for node in node_defaults('irb120').items())])


def _work(_arguments: argparse.Namespace) -> None:
    sys.stdout.write(page())


def _section(node: str, settings: Any) -> str:
    rows = ''.join(_rows(flatten(settings), _CHANGEABLE.get(node, lambda _: False)))
    return f'\n## {node}\n\n| name | default | allowed | meaning |\n|---|---|---|---|\n{rows}'


def _rows(
    values: dict[str, tuple[Any, Described]], changeable: Callable[[str], bool]
) -> Iterator[str]:
    for name, (value, described) in values.items():
        shown = f'`{name}` *' if changeable(name) else f'`{name}`'
        yield f'| {shown} | {_text(value)} | {_allowed(value, described)} | {described.text} |\n'


def _allowed(value: Any, described: Described) -> str:
    if isinstance(value, bool):
        return 'true or false'
    if isinstance(value, str) and not described.choices:
        return 'text'
    return described.range_text()


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f'{value:g}' if isinstance(value, float) else str(value)


if __name__ == '__main__':
    sys.exit(main())
