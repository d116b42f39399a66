"""`ros2 run push_bringup cell`: one recorded and scored run of the whole cell.

What only one step needs is imported there: so the nodes start to start a second earlier.
"""
# ruff: noqa: PLC0415

import argparse
import sys
import tempfile
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from push_core.common import InputError, Parser, RunError, run_command
from push_core.tracks import TRACKS
from push_gp.models import ANALYTICAL, read_sealed
from push_mpc.plan import Plan, planned
from push_mpc.settings import CONTROLLERS, PRESETS
from push_node.override_text import parsed_override
from push_sim.settings import PROFILES

from push_bringup.setup import (
    CellParameters,
    Request,
    installed_config,
    keep_logs,
    new_run_folder,
    resolved,
    write_inputs,
)

EPILOG = """examples:
  ros2 run push_bringup cell                                   the 8-track at 80 mm/s
  ros2 run push_bringup cell --track square --speed 0.05 --controller analytical
  ros2 run push_bringup cell --mode inprocess -p delay_compensation:=false
  ros2 run push_bringup cell -p mpc_node.weights.contact:=100.0 -o /tmp/runs

The last line printed is the folder of the run: bag, score.json, report.html, logs.
Exit status: 0 the lap was completed, 1 it was not, 2 the command was wrong, 130 interrupted.
"""


OFF_AT_END = 'object or pusher are not where they should be at its end; see the report'


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the cell once."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    parser = Parser('Pushes the square along a track, records the run and scores it.', EPILOG)
    tracks = ', '.join(TRACKS)
    parser.add_argument('--track', default='eight', help=f'{tracks} or a .csv of x, y [m]')
    parser.add_argument('--speed', type=float, default=0.08, help='[m/s] (default %(default)s)')
    parser.add_argument('--controller', choices=tuple(CONTROLLERS), default='gp')
    parser.add_argument(
        '--model', type=Path, metavar='FILE', help='for gp; default: 200 simulated pushes'
    )
    parser.add_argument('--profile', choices=tuple(PROFILES), default='irb120')
    parser.add_argument(
        '--preset',
        choices=PRESETS,
        default='tuned',
        help='of the controller; paper: its literal weights, h and N (default %(default)s)',
    )
    parser.add_argument(
        '--perturb',
        choices=('none', 'normal', 'tangential'),
        default='none',
        help='displacement before the start: 30 mm off the pusher, or 20 mm along the face',
    )
    parser.add_argument('--laps', type=int, default=1, help='rounds of a closed track')
    parser.add_argument('--seed', type=int, default=0, help='of all that is drawn at random')
    parser.add_argument(
        '--mode',
        choices=('realtime', 'lockstep', 'inprocess'),
        default='realtime',
        help='wall clock; nodes in step, repeatable; one process, fastest',
    )
    parser.add_argument(
        '-p',
        '--param',
        action='append',
        default=[],
        metavar='NAME:=VALUE',
        help='any parameter of a node, as NAME or NODE.NAME; repeatable',
    )
    parser.add_argument(
        '--params',
        type=Path,
        metavar='FILE',
        help='ROS parameter file over the defaults, such as that of push_sim calibrate',
    )
    parser.add_argument('--namespace', default='', help='of the node graph')
    parser.add_argument(
        '-o',
        '--output',
        type=Path,
        default=Path('runs'),
        metavar='DIR',
        help='the run gets a new folder in it (default %(default)s)',
    )
    return parser


def work(arguments: argparse.Namespace) -> int:
    """Checks everything that can be checked, then runs, scores and reports.

    Raises:
        InputError: the request cannot be carried out.
        RunError: the run could not be recorded or scored.
    """
    request = _request(arguments)
    folder = new_run_folder(request, datetime.now().astimezone())
    with tempfile.TemporaryDirectory(prefix='push_cell_') as scratch:
        inputs = Path(scratch)
        parameters = resolved(request, installed_config('cell.yaml'), folder, inputs)
        plan = planned(parameters.mpc)
        write_inputs(request, parameters, plan, inputs)
        try:
            reason = _run(request, parameters, plan, inputs)
        except KeyboardInterrupt:
            if folder.is_dir():
                sys.stderr.write(f'cell: what was recorded until now is in {folder}\n')
            raise
        finally:
            keep_logs(inputs, folder)
    return _finish(folder, reason)


def _run(request: Request, parameters: CellParameters, plan: Plan, inputs: Path) -> str:
    """Runs the cell; returns why it ended before its end, empty if it did not."""
    if request.mode == 'inprocess':
        from push_gp.models.model_source import model_named

        from push_bringup.in_process.run import recorded_in_process

        model = model_named(request.model, parameters.gp.slider)
        return recorded_in_process(parameters, model, plan)
    from push_bringup.graph.node_graph import run_graph

    return run_graph(inputs / 'params.yaml', request, inputs)


def _request(arguments: argparse.Namespace) -> Request:
    if arguments.model and not CONTROLLERS[arguments.controller].trained_model:
        raise InputError(f'--model is not for --controller {arguments.controller}')
    if not arguments.speed > 0.0:
        raise InputError(f'--speed is {arguments.speed:g}, must be above 0 m/s')
    overrides = dict(parsed_override(text) for text in arguments.param)
    return Request(
        track=arguments.track,
        speed=arguments.speed,
        controller=arguments.controller,
        model=_model(arguments),
        profile=arguments.profile,
        perturb=arguments.perturb,
        laps=arguments.laps,
        seed=arguments.seed,
        mode=arguments.mode,
        output=arguments.output,
        namespace=_namespace(arguments.namespace),
        overrides=overrides,
        preset=arguments.preset,
        params=arguments.params,
    )


def _namespace(text: str) -> str:
    """Without slashes around it; most cells have none, and need no rclpy here."""
    name = text.strip('/')
    if name:
        from rclpy.exceptions import InvalidNamespaceException
        from rclpy.validate_namespace import validate_namespace

        try:
            validate_namespace(f'/{name}')
        except InvalidNamespaceException:
            raise InputError(f'--namespace {text!r}: takes letters, digits, _ and /') from None
    return name


def _model(arguments: argparse.Namespace) -> str:
    if not CONTROLLERS[arguments.controller].trained_model:
        return ANALYTICAL
    model = arguments.model
    if model is None:
        from push_bringup.setup.default_model import default_model

        model = default_model()
    read_sealed(model)
    return str(model.resolve())


def _finish(folder: Path, reason: str) -> int:
    """Scores what was recorded, says how it went, and ends with the folder's path."""
    if not folder.is_dir():
        raise RunError(f'the cell did not get as far as recording: {reason}')
    from push_bag.report.report import write_results
    from push_bag.score.score_table import score_table

    try:
        score = write_results(folder, reason)
    except InputError as error:
        raise RunError(f'{reason or error}; what was recorded is in {folder}') from error
    sys.stdout.write(score_table(score))
    if not score['completed']:
        sys.stderr.write(f'cell: the run was not completed: {reason or OFF_AT_END}\n')
    sys.stdout.write(f'{folder}\n')
    return 0 if score['completed'] and not reason else 1


if __name__ == '__main__':
    sys.exit(main())
