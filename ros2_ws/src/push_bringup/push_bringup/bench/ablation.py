"""`bench ablation`: what each part of the controller is worth, with one part off at a time."""

import argparse
import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from push_core.common import Parser, json_text, run_command
from push_gp.models import ANALYTICAL
from push_sim.settings import PROFILES

from push_bringup.bench.options import add_lap_options, check_positive, opened_store
from push_bringup.experiment import PAPER_MM, Experiment, Lap, LapJob, push_all
from push_bringup.setup import default_model

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
"""What is off, and the parameters that switch it off."""

EPILOG = """Example: bench ablation --seeds 3 --controller gp
Exit status: 0 done, also where laps were not completed, 2 the command was wrong.
"""


@dataclass(frozen=True)
class AblationRow:
    """One variant: the laps of each experiment."""

    variant: str
    laps: tuple[tuple[Lap, ...], ...]

    @property
    def command_step(self) -> float:
        """Change of the command from tick to tick, rms, median of the first experiment [mm/s]."""
        return median(lap.command_step_mm_s for lap in self.laps[0])

    def as_json(self) -> dict[str, object]:
        """The row as `--json` prints it."""
        return {
            'variant': self.variant,
            'completed': [sum(lap.completed for lap in own) for own in self.laps],
            'seeds': [len(own) for own in self.laps],
            'median_mm': [median(lap.mean_mm for lap in own) for own in self.laps],
            'command_step_mm_s': self.command_step,
        }


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser("Pushes the paper's rows, and 150 mm/s, with parts off.", EPILOG)
    described.prog = 'bench ablation'
    described.add_argument('--seeds', type=int, default=3, help='laps of each (default 3)')
    described.add_argument('--profile', choices=tuple(PROFILES), default='irb120')
    described.add_argument('--controller', choices=('gp', 'analytical'), default='gp')
    described.add_argument(
        '--model', metavar='FILE', help='of the gp controller; default: 200 simulated pushes'
    )
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
    text = table(rows)
    if arguments.html is not None:
        # plotly takes a second to import: only who asks for a page waits for it
        from push_report.page import write_page  # noqa: PLC0415

        write_page(arguments.html, 'What each part is worth', text.splitlines(), ())
    if arguments.json:
        text = json_text({'rows': [row.as_json() for row in rows]})
    sys.stdout.write(text)


def _jobs(arguments: argparse.Namespace) -> list[LapJob]:
    """All laps: by variant, then by experiment, then by seed."""
    model = ANALYTICAL
    if arguments.controller == 'gp':
        model = arguments.model or str(default_model())
    return [
        LapJob(experiment, arguments.controller, model, arguments.profile, seed, overrides)
        for overrides in VARIANTS.values()
        for experiment in EXPERIMENTS
        for seed in range(arguments.seeds)
    ]


def table(rows: Sequence[AblationRow]) -> str:
    """The rows as a Markdown table: median error, and the laps where some were not completed.

    The last column tells by how much the command changes from tick to tick in the first one.
    """
    names = [
        f'{one.track} {1e3 * one.speed:.0f} mm/s'
        + ('' if one.perturbation == 'none' else f', {one.perturbation}')
        for one in EXPERIMENTS
    ]
    names.append('command step')
    head = '| controller | ' + ' | '.join(names) + ' |\n' + '|---' * (len(names) + 1) + '|\n'
    return head + ''.join(
        f'| {row.variant} | {" | ".join(map(_cell, row.laps))} | {row.command_step:.0f} mm/s |\n'
        for row in rows
    )


def _cell(laps: tuple[Lap, ...]) -> str:
    completed = sum(lap.completed for lap in laps)
    error = median(lap.mean_mm for lap in laps)
    text = f'{error:.2f} mm' if math.isfinite(error) else 'never tracked'
    return text if completed == len(laps) else f'{text} ({completed} of {len(laps)} laps)'


if __name__ == '__main__':
    sys.exit(main())
