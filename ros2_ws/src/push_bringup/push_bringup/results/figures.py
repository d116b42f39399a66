"""The figures that documents quote, by name."""

import re
from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias

Figure: TypeAlias = float | int | str
Named: TypeAlias = Iterator[tuple[str, Figure | None]]


def figures(sections: Mapping[str, Mapping[str, Any]]) -> dict[str, Figure]:
    """All figures of the sections of results.json by name; errors in mm, times in ms.

    Names: `eight_80_gp` (median error of the paper's row, profile irb120), `eight_80_gp_truth`
    (of the true poses), `harsh_eight_80_gp` (another profile),
    `without_delay_prediction_eight_80` (ablation), `training_size_200_zero_random`,
    `solver_gp_ours_osqp_p99`, `real_time_eight_80_gp`, `table_date` (when a section was made).
    """
    named: dict[str, Figure] = {}
    for name, section in sections.items():
        named[f'{name}_date'] = section['made']['date']
        for figure, value in _FIGURES[name](name, section['results']):
            if value is not None:
                named[figure] = value
    return named


def _paper_rows(section: str, results: Mapping[str, Any]) -> Named:
    yield f'{section}_laps', sum(row['seeds'] for row in results['rows'])
    yield f'{section}_completed', sum(row['completed'] for row in results['rows'])
    for row in results['rows']:
        prefix = '' if row['profile'] == 'irb120' else f'{row["profile"]}_'
        name = f'{prefix}{_experiment(row)}_{row["controller"]}'
        yield name, row['median_mm']
        yield f'{name}_truth', row.get('truth_median_mm')


def _sizes(section: str, results: Mapping[str, Any]) -> Named:
    for row in results['points']:
        name = f'{section}_{row["n"]}_{row["mean_function"]}_{row["choice"]}'
        yield name, row['median_mm']


def _ablation(_section: str, results: Mapping[str, Any]) -> Named:
    for row in results['rows']:
        variant = _word(row['variant'])
        yield f'{variant}_command_step', row['command_step_mm_s']
        columns = zip(results['experiments'], row['median_mm'], row['completed'], strict=True)
        for experiment, error, completed in columns:
            yield f'{variant}_{_experiment(experiment)}', error
            yield f'{variant}_{_experiment(experiment)}_completed', completed


def _mismatch(section: str, results: Mapping[str, Any]) -> Named:
    for row in results['rows']:
        name = f'{section}_{_word(row["plant"])}_{row["controller"]}'
        yield name, row['laps_mm'][0]
        if row['learn']:
            yield f'{name}_lap_2', row['laps_mm'][min(1, len(row['laps_mm']) - 1)]
            yield f'{name}_last', row['laps_mm'][-1]


def _solvers(section: str, results: Mapping[str, Any]) -> Named:
    for row in results['solvers']:
        for key in ('p50', 'p99', 'max'):
            yield f'{section}_{_word(row["name"])}_{key}', row[f'{key}_ms']


def _real_time(section: str, results: Mapping[str, Any]) -> Named:
    rows = results['rows']
    for row in rows:
        yield f'{section}_{_experiment(row)}_{row["controller"]}', row['real_time_mm']
    yield f'{section}_laps', sum(row['runs'] for row in rows)
    yield f'{section}_late_commands', sum(row['deadline_misses'] for row in rows)
    yield f'{section}_largest_deviation_percent', 100 * max(abs(row['ratio'] - 1) for row in rows)


def _plant(section: str, results: Mapping[str, Any]) -> Named:
    short = results['pushes_4mm']
    yield f'{section}_nmse', short['nmse_push_frame']['mean']
    yield f'{section}_nmse_ellipsoid', short['limit_surface']['nmse_push_frame']['mean']
    for run in results['robot_runs']:
        name = _word(run['file'].removesuffix('.csv'))
        yield f'{section}_{name}_tip', run['tip_rms_mm']
        yield f'{section}_{name}_tip_distance', run['tip_distance_rms_mm']


def _learning_curve(section: str, results: Mapping[str, Any]) -> Named:
    for point in results['points']:
        name = f'{section}_{point["n"]}_{_word(point["method"])}'
        yield name, point['nmse_push_frame']['median']


_FIGURES = {
    'table': _paper_rows,
    'harsh': _paper_rows,
    'measured': _sizes,
    'training_size': _sizes,
    'ablation': _ablation,
    'mismatch': _mismatch,
    'learning': _mismatch,
    'solver_gp': _solvers,
    'solver_analytical': _solvers,
    'real_time': _real_time,
    'plant': _plant,
    'learning_curve': _learning_curve,
}


def _experiment(row: Mapping[str, Any]) -> str:
    name = f'{row["track"]}_{1e3 * row["speed_m_s"]:.0f}'
    return name if row['perturbation'] == 'none' else f'{name}_{row["perturbation"]}'


def _word(text: str) -> str:
    return re.sub(r'[^a-z0-9]+', '_', text.lower()).strip('_')
