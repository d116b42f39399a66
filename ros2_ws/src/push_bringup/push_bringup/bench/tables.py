"""Markdown tables of the benchmarks, made from the object that `--json` prints."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeAlias

from push_core.common import markdown_table as markdown_lines

BenchResults: TypeAlias = Mapping[str, Any]
"""The JSON object of a benchmark."""

PAPER_KEYS = ('median_mm', 'truth_median_mm', 'spread_mm', 'paper_mm')
"""Of a row of `bench table`: median errors of the measured and of the true poses, and others."""


def markdown_table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A Markdown table of a head and rows of cells."""
    cells = (tuple(map(str, row)) for row in rows)
    return '\n'.join(markdown_lines(head, cells)) + '\n'


def paper_rows(results: BenchResults) -> str:
    """The table of `bench table`."""
    heads = ('profile', 'track', 'speed', 'perturbation', 'controller', 'laps', 'median')
    return markdown_table(
        (*heads, 'truth', 'spread', 'paper'),
        (
            (
                row['profile'],
                *_experiment(row),
                row['controller'],
                f'{row["completed"]} of {row["seeds"]}',
                *(_millimetres(row.get(key)) for key in PAPER_KEYS),
            )
            for row in results['rows']
        ),
    )


def size_rows(results: BenchResults) -> str:
    """The table of `bench data`, and the analytical controller's lap below it."""
    table = markdown_table(
        ('pushes', 'choice', 'mean function', 'completed', 'median', 'quartiles'),
        (
            (
                row['n'],
                row['choice'],
                row['mean_function'],
                f'{row["completed"]} of {row["draws"]}',
                _millimetres(row['median_mm']),
                ' … '.join(f'{value:.2f}' for value in row['quartiles_mm'] or ()) + ' mm'
                if row['quartiles_mm']
                else '–',
            )
            for row in results['points']
        ),
    )
    lap = results['analytical']
    ended = 'completed' if lap['completed'] else lap['stop_reason']
    return f'{table}\nanalytical controller: {_millimetres(lap["mean_mm"])}, {ended}\n'


def ablation_rows(results: BenchResults) -> str:
    """The table of `bench ablation`: median error, and the laps where not all were completed.

    The last column is the change of the command from tick to tick in the first experiment.
    """
    names = [experiment_name(one) for one in results['experiments']]
    return markdown_table(
        ('controller', *names, 'command step'),
        (
            (
                row['variant'],
                *map(_ablation_cell, row['median_mm'], row['completed'], row['seeds']),
                f'{row["command_step_mm_s"]:.0f} mm/s',
            )
            for row in results['rows']
        ),
    )


def _ablation_cell(error: float | None, completed: int, seeds: int) -> str:
    text = 'never tracked' if error is None else _millimetres(error)
    return text if completed == seeds else f'{text} ({completed} of {seeds} laps)'


def mismatch_rows(results: BenchResults) -> str:
    """The table of `bench mismatch`: a line for each plant, a column for each controller.

    Of several laps it has the first, the second and the last.
    """
    by_plant: dict[str, dict[str, Mapping[str, Any]]] = {}
    for row in results['rows']:
        by_plant.setdefault(row['plant'], {})[row['controller']] = row
    controllers = list(next(iter(by_plant.values())))
    return markdown_table(
        ('row', 'plant differs by', 'pushed', *controllers),
        (
            (
                plant,
                rows[controllers[0]]['text'],
                experiment_name(rows[controllers[0]]),
                *(_mismatch_cell(rows[controller]) for controller in controllers),
            )
            for plant, rows in by_plant.items()
        ),
    )


def _mismatch_cell(row: Mapping[str, Any]) -> str:
    count = (
        f'{row["completed"]} of {row["seeds"]} {"laps" if len(row["laps_mm"]) == 1 else "runs"}'
    )
    if not row['completed']:
        return f'lost ({count})'
    laps = dict.fromkeys((0, min(1, len(row['laps_mm']) - 1), len(row['laps_mm']) - 1))
    text = ' → '.join(_millimetres(row['laps_mm'][lap]) for lap in laps)
    return text if row['completed'] == row['seeds'] else f'{text} ({count})'


def solver_rows(results: BenchResults) -> str:
    """The table of `bench timing`."""
    return markdown_table(
        ('solver', 'p50', 'p99', 'p99.9', 'max', 'iterations', 'first input'),
        (
            (
                row['name'],
                *(f'{row[key]:.2f} ms' for key in ('p50_ms', 'p99_ms', 'p999_ms', 'max_ms')),
                row['iterations_max'],
                f'{row["first_input_error_m_s"]:.1e} m/s',
            )
            for row in results['solvers']
        ),
    )


def real_time_rows(results: BenchResults) -> str:
    """The table of `bench realtime`."""
    heads = ('track', 'speed', 'perturbation', 'controller', 'laps', 'in process', 'real time')
    return markdown_table(
        (*heads, 'ratio', 'late commands'),
        (
            (
                *_experiment(row),
                row['controller'],
                f'{row["completed"]} of {row["runs"]}',
                _millimetres(row['in_process_mm']),
                _millimetres(row['real_time_mm']),
                f'{row["ratio"]:.2f}',
                row['deadline_misses'],
            )
            for row in results['rows']
        ),
    )


def time_ranges(results: BenchResults) -> str:
    """The times of the runs of `bench realtime`: smallest to largest of the runs [ms]."""
    columns = [
        ('solve p50', 'solve_ms', 'p50'),
        ('p99', 'solve_ms', 'p99'),
        ('max', 'solve_ms', 'max'),
        ('tick p99', 'tick_ms', 'p99'),
        ('pose to command p50', 'pose_to_command_ms', 'p50'),
        ('p99', 'pose_to_command_ms', 'p99'),
        ('max', 'pose_to_command_ms', 'max'),
    ]
    return markdown_table(
        ('controller', 'laps', *(head for head, _, _ in columns)),
        (
            (row['controller'], row['runs'], *(_range(row[name][key]) for _, name, key in columns))
            for row in results['times']
        ),
    )


def library_rows(results: BenchResults) -> str:
    """The table of `bench model`."""
    return markdown_table(
        ('library', 'fit', '35 means and Jacobians', 'memory', 'log likelihood', 'NMSE'),
        (
            (
                row['name'],
                f'{row["fit_s"]:.2f} s',
                f'{row["predict_ms"]:.2f} ms',
                f'{row["memory_mb"]:.0f} MB',
                f'{row["log_likelihood"]:.2f}',
                f'{row["nmse_push_frame"]:.4f}',
            )
            for row in results['rivals']
        ),
    )


TABLES: Mapping[str, Callable[[BenchResults], str]] = {
    'table': paper_rows,
    'data': size_rows,
    'ablation': ablation_rows,
    'mismatch': mismatch_rows,
    'timing': solver_rows,
    'realtime': real_time_rows,
    'model': library_rows,
}
"""Word after `bench`, to the table of its JSON object."""


def experiment_name(row: Mapping[str, Any]) -> str:
    """Track, speed and perturbation for a head, such as 'eight 80 mm/s, normal'."""
    track, speed, perturbation = _experiment(row)
    return f'{track} {speed}' + ('' if perturbation == 'none' else f', {perturbation}')


def _experiment(row: Mapping[str, Any]) -> tuple[str, str, str]:
    return row['track'], f'{1e3 * row["speed_m_s"]:.0f} mm/s', row['perturbation']


def _millimetres(value: float | None) -> str:
    return '–' if value is None else f'{value:.2f} mm'


def _range(pair: Sequence[float]) -> str:
    return f'{pair[0]:.2f}–{pair[1]:.2f}'
