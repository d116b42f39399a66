"""`bench ablation`: the controller with one part switched off at a time."""

import argparse
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from push_core.common import Parser, finite, run_command
from push_sim.settings import PROFILES

from push_bringup.bench.options import (
    add_controller,
    add_lap_options,
    check_positive,
    opened_store,
    print_results,
)
from push_bringup.bench.rows import AblationRow, experiment_json
from push_bringup.bench.tables import ablation_rows
from push_bringup.experiment import PAPER_MM, Experiment, LapJob, push_all
from push_bringup.setup import model_for

EXPERIMENTS = (*PAPER_MM, Experiment('eight', 0.15))
VARIANTS: Mapping[str, Mapping[str, object]] = {
    'tuned': {},
    'without consistent plan': {'consistent_plan': False},
    'without model-error estimate': {'disturbance_length': 0.0},
    'without either': {'consistent_plan': False, 'disturbance_length': 0.0},
    'without delay prediction': {'delay_compensation': False},
    'without weight on changes': {'weights.change': 0.0, 'force_weights.change': 0.0},
    '35 steps, the same length': {'horizon_steps': 35},
    '35 steps, 0.35 s': {'horizon_steps': 35, 'horizon_step': 0.01},
    'preset paper': {'preset': 'paper'},
}
"""Name of a variant, to the parameters that make it."""

EPILOG = """Example: bench ablation --seeds 3 --controller gp
Exit status: 0 done, also where laps were not completed, 2 the command was wrong.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser(
        "Pushes the paper's experiments, and 150 mm/s, with parts switched off.", EPILOG
    )
    described.prog = 'bench ablation'
    described.add_argument('--seeds', type=int, default=3, help='laps of each (default 3)')
    described.add_argument('--profile', choices=tuple(PROFILES), default='irb120')
    add_controller(described)
    add_lap_options(described, Path('runs/bench_ablation.jsonl'))
    return described


def work(arguments: argparse.Namespace) -> None:
    """Pushes all variants and prints them.

    Raises:
        InputError: the model cannot be read, or a number is out of range.
    """
    check_positive('--seeds', arguments.seeds)
    store = opened_store(arguments)
    jobs = _jobs(arguments)
    laps = iter(push_all(jobs, store, arguments.jobs))
    rows = [
        AblationRow(
            variant,
            tuple(tuple(next(laps) for _ in range(arguments.seeds)) for _ in EXPERIMENTS),
        )
        for variant in VARIANTS
    ]
    results = {
        'experiments': [experiment_json(each) for each in EXPERIMENTS],
        'rows': [row.as_json() for row in rows],
    }
    if arguments.html is not None:
        # plotly takes a second to import: only a page needs it
        from push_report.page import write_page  # noqa: PLC0415

        lines = ablation_rows(finite(results)).splitlines()
        write_page(arguments.html, 'The effect of each part', lines, ())
    print_results(arguments, 'ablation', results)


def _jobs(arguments: argparse.Namespace) -> list[LapJob]:
    """All laps: by variant, then by experiment, then by seed."""
    model = model_for(arguments.controller, arguments.model)
    return [
        LapJob(experiment, arguments.controller, model, arguments.profile, seed, overrides)
        for overrides in VARIANTS.values()
        for experiment in EXPERIMENTS
        for seed in range(arguments.seeds)
    ]


if __name__ == '__main__':
    sys.exit(main())
