"""The commands whose results are published, with the table of each."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from push_sim.validation import validation_rows

from push_bringup.bench import BENCHES, TABLES, BenchResults, markdown_table


@dataclass(frozen=True)
class PublishedCommand:
    """A command that prints one JSON object with `--json`.

    Attributes:
        text: how it is called.
        module: its module, which has `main` and `parser`.
        table: its JSON object as a Markdown table.
    """

    text: str
    module: str
    table: Callable[[BenchResults], str]


def validation_table(results: BenchResults) -> str:
    """The table of `push_sim validate`."""
    head, *rows = validation_rows(results, results['profile'])
    return markdown_table(head, ([cell.strip() for cell in row] for row in rows))


def curve_table(results: BenchResults) -> str:
    """The table of `push_gp curve`: median (worst) of the seeds, and coverage."""
    sizes: dict[int, dict[str, Mapping[str, object]]] = {}
    for point in results['points']:
        sizes.setdefault(point['n'], {})[point['method']] = point
    methods = list(next(iter(sizes.values())))
    return markdown_table(
        ('N', *methods, 'in the 95 % interval, zero'),
        (
            (n, *(_nmse(own[method]) for method in methods), f'{own["zero"]["coverage_95"]:.3f}')
            for n, own in sizes.items()
        ),
    )


def _nmse(point: BenchResults) -> str:
    seeds = point['nmse_push_frame']
    return f'{seeds["median"]:.3f} ({seeds["worst"]:.3f})'


COMMANDS: Mapping[str, PublishedCommand] = {
    **{
        name: PublishedCommand(f'ros2 run push_bringup bench {name}', BENCHES[name][0], table)
        for name, table in TABLES.items()
    },
    'validate': PublishedCommand(
        'ros2 run push_sim validate', 'push_sim.commands.validate', validation_table
    ),
    'curve': PublishedCommand('ros2 run push_gp curve', 'push_gp.commands.curve', curve_table),
}
"""Last word of a command, to what is published of it."""
