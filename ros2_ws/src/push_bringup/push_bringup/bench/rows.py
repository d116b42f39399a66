"""The rows of the benchmarks' tables, and each as `--json` prints it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean, median
from typing import Any

import numpy as np
from push_core.geometry import Array

from push_bringup.experiment import PAPER_MM, Experiment, Lap


@dataclass(frozen=True)
class PaperRow:
    """`bench table`: all laps of an experiment with one controller in one profile."""

    experiment: Experiment
    controller: str
    profile: str
    laps: tuple[Lap, ...]

    @property
    def completed(self) -> int:
        """Number of completed laps."""
        return sum(lap.completed for lap in self.laps)

    def as_json(self) -> dict[str, Any]:
        """The row as `--json` prints it."""
        errors = [lap.mean_mm for lap in self.laps]
        return {
            **experiment_json(self.experiment),
            'controller': self.controller,
            'profile': self.profile,
            'seeds': len(self.laps),
            'completed': self.completed,
            'median_mm': median(errors),
            'truth_median_mm': median(lap.truth_mean_mm for lap in self.laps),
            'mean_mm': fmean(errors),
            'spread_mm': max(errors) - min(errors),
            'paper_mm': PAPER_MM[self.experiment].get(self.controller),
        }


@dataclass(frozen=True)
class SizeRow:
    """`bench data`: the laps of all training sets of one size."""

    points: int
    mean: str
    choice: str
    laps: tuple[Lap, ...]

    @property
    def completed(self) -> int:
        """Number of completed laps."""
        return sum(lap.completed for lap in self.laps)

    @property
    def quartiles(self) -> tuple[float, float, float] | None:
        """Lower quartile, median and upper quartile [mm] of the completed laps, if any."""
        errors = [lap.mean_mm for lap in self.laps if lap.completed]
        if not errors:
            return None
        low, middle, high = np.percentile(errors, [25.0, 50.0, 75.0]).tolist()
        return low, middle, high

    def as_json(self) -> dict[str, Any]:
        """The row as `--json` prints it."""
        low, middle, high = self.quartiles or (None, None, None)
        return {
            'n': self.points,
            'mean_function': self.mean,
            'choice': self.choice,
            'draws': len(self.laps),
            'completed': self.completed,
            'median_mm': middle,
            'quartiles_mm': None if middle is None else [low, high],
        }


@dataclass(frozen=True)
class AblationRow:
    """`bench ablation`: one variant of the controller, and its laps of each experiment."""

    variant: str
    laps: tuple[tuple[Lap, ...], ...]

    @property
    def command_step(self) -> float:
        """Change of the command from tick to tick [mm/s], rms, median of the first experiment."""
        return median(lap.command_step_mm_s for lap in self.laps[0])

    def as_json(self) -> dict[str, Any]:
        """The row as `--json` prints it."""
        return {
            'variant': self.variant,
            'completed': [sum(lap.completed for lap in own) for own in self.laps],
            'seeds': [len(own) for own in self.laps],
            'median_mm': [median(lap.mean_mm for lap in own) for own in self.laps],
            'command_step_mm_s': self.command_step,
        }


@dataclass(frozen=True)
class MismatchRow:
    """`bench mismatch`: one plant with one controller.

    Attributes:
        plant: its name.
        text: how it differs from what the controller assumes.
        experiment: what was pushed on it.
        controller: its name.
        laps: one run for each seed.
        learn: whether each lap taught the next.
    """

    plant: str
    text: str
    experiment: Experiment
    controller: str
    laps: tuple[Lap, ...]
    learn: bool = False

    @property
    def completed(self) -> int:
        """Number of completed runs."""
        return sum(lap.completed for lap in self.laps)

    def as_json(self) -> dict[str, Any]:
        """The row as `--json` prints it; errors are medians of the completed runs, by round."""
        rounds = [[one.truth_mean_mm for one in lap.per_lap] for lap in self.laps if lap.completed]
        return {
            'plant': self.plant,
            'text': self.text,
            **experiment_json(self.experiment),
            'controller': self.controller,
            'learn': self.learn,
            'seeds': len(self.laps),
            'completed': self.completed,
            'laps_mm': [median(each) for each in zip(*rounds, strict=True)] or [None],
            'stop_reasons': [lap.stop_reason for lap in self.laps if not lap.completed],
        }


@dataclass(frozen=True)
class SolverRow:
    """`bench timing`: one solver on the QPs of all ticks.

    Attributes:
        name: of the solver.
        milliseconds: each tick took (n,).
        iterations_max: most iterations in a tick.
        first_input_error: largest error of the first input [m/s].
    """

    name: str
    milliseconds: Array
    iterations_max: int
    first_input_error: float

    def as_json(self) -> dict[str, Any]:
        """The row as `--json` prints it."""
        p50, p99, p999 = np.percentile(self.milliseconds, [50.0, 99.0, 99.9]).tolist()
        return {
            'name': self.name,
            'p50_ms': p50,
            'p99_ms': p99,
            'p999_ms': p999,
            'max_ms': float(self.milliseconds.max()),
            'iterations_max': self.iterations_max,
            'first_input_error_m_s': self.first_input_error,
        }


@dataclass(frozen=True)
class RealTimeRow:
    """`bench realtime`: one experiment with one controller, in process and in real time.

    Attributes:
        experiment: what was pushed.
        controller: its name.
        in_process_mm: mean tracking error of each run in process, seeds 0, 1, ….
        scores: of each run in real time, as `push_bag score --json` prints them.
    """

    experiment: Experiment
    controller: str
    in_process_mm: tuple[float, ...]
    scores: tuple[Mapping[str, Any], ...]

    @property
    def completed(self) -> int:
        """Number of completed runs in real time."""
        return sum(bool(score['completed']) for score in self.scores)

    def as_json(self) -> dict[str, Any]:
        """The row as `--json` prints it."""
        in_process = median(self.in_process_mm)
        real_time = median(score['tracking_error_mm']['mean'] for score in self.scores)
        return {
            **experiment_json(self.experiment),
            'controller': self.controller,
            'runs': len(self.scores),
            'completed': self.completed,
            'in_process_mm': in_process,
            'real_time_mm': real_time,
            'ratio': real_time / in_process,
            'deadline_misses': sum(score['deadline_misses'] or 0 for score in self.scores),
        }


TIMES = ('solve_ms', 'tick_ms', 'pose_to_command_ms')


def times_json(controller: str, rows: Sequence[RealTimeRow]) -> dict[str, Any]:
    """Smallest and largest value of each time of a controller over its runs in real time."""
    scores = [score for row in rows if row.controller == controller for score in row.scores]
    ranges = {
        name: {
            key: [min(values), max(values)]
            for key in ('p50', 'p99', 'max')
            if (values := [score[name][key] for score in scores if score[name][key] is not None])
        }
        for name in TIMES
    }
    return {'controller': controller, 'runs': len(scores), **ranges}


@dataclass(frozen=True)
class LibraryRow:
    """`bench model`: one library on the same training set.

    Attributes:
        name: of the library.
        fit_s: seconds of processor time for all three outputs, with hyperparameters.
        predict_ms: milliseconds for mean and Jacobian of 35 pushes, the median of many.
        memory_mb: peak memory of the fit, less that of the imports.
        log_likelihood: of the training pushes [nat], the sum over the outputs.
        nmse_push_frame: on pushes held out.
    """

    name: str
    fit_s: float
    predict_ms: float
    memory_mb: float
    log_likelihood: float
    nmse_push_frame: float


def experiment_json(experiment: Experiment) -> dict[str, Any]:
    """The part of a row that names its experiment."""
    return {
        'track': experiment.track,
        'speed_m_s': experiment.speed,
        'perturbation': experiment.perturbation,
    }
