"""`ros2 run push_bringup cell`: one recorded and scored run of the whole cell.

Heavy imports are local to the step that needs them, so that the nodes start a second earlier.
"""
# ruff: noqa: PLC0415

import argparse
import sys
import tempfile
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from push_core.common import InputError, RunError, run_command
from push_mpc.plan import Plan, planned

from push_bringup.commands.cell_options import parser, requested
from push_bringup.setup import (
    PARAMETERS_FILE,
    CellParameters,
    Request,
    check_effective,
    installed_config,
    keep_logs,
    new_run_folder,
    recorded_in,
    resolved,
    write_inputs,
)

OFF_AT_END = 'object or pusher are not where they should be at its end; see the report'


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the cell once."""
    return run_command(parser(), work, argv)


def work(arguments: argparse.Namespace) -> int:
    """Checks the request, then runs, scores and reports.

    Raises:
        InputError: the request cannot be carried out.
        RunError: the run could not be recorded or scored.
    """
    request = requested(arguments)
    parameters = resolved(request, installed_config('cell.yaml'))
    check_effective(request, parameters)
    folder = new_run_folder(request.output, parameters.mpc, datetime.now().astimezone())
    with tempfile.TemporaryDirectory(prefix='push_cell_') as scratch:
        inputs = Path(scratch)
        plan = planned(parameters.mpc)
        if request.learn_from is not None:
            from push_bringup.commands.taught import taught_by

            parameters = taught_by(request.learn_from, parameters, plan, inputs)
        parameters = recorded_in(parameters, folder, inputs)
        write_inputs(request, parameters, plan, inputs)
        try:
            reason = _run(request, parameters, plan, inputs)
        except KeyboardInterrupt:
            if folder.is_dir():
                sys.stderr.write(f'cell: the recording so far is in {folder}\n')
            raise
        finally:
            keep_logs(inputs, folder)
    return _finish(folder, reason)


def _run(request: Request, parameters: CellParameters, plan: Plan, inputs: Path) -> str:
    """Runs the cell; returns the reason of an early end, else an empty string."""
    if request.is_in_process:
        from push_gp.models.model_file import model_named

        from push_bringup.in_process.run import recorded_in_process

        model = model_named(parameters.gp.model, parameters.gp.slider, parameters.gp.distance)
        return recorded_in_process(parameters, model, plan)
    from push_bringup.graph.node_graph import run_graph

    lessons = parameters.mpc.laps if parameters.mpc.learn else 0
    params = inputs / PARAMETERS_FILE
    return run_graph(params, request.namespace, inputs, watch=request.watch, lessons=lessons)


def _finish(folder: Path, reason: str) -> int:
    """Scores the recording and prints score and folder; returns the exit status."""
    if not folder.is_dir():
        raise RunError(f'the cell stopped before it recorded anything: {reason}')
    from push_bag.report.report import write_results
    from push_bag.score.score_table import score_table

    try:
        score = write_results(folder, reason)
    except InputError as error:
        raise RunError(f'{reason or error}; the recording is in {folder}') from error
    sys.stdout.write(score_table(score))
    if not score['completed']:
        sys.stderr.write(f'cell: the run was not completed: {reason or OFF_AT_END}\n')
    sys.stdout.write(f'{folder}\n')
    return 0 if score['completed'] and not reason else 1


if __name__ == '__main__':
    sys.exit(main())
