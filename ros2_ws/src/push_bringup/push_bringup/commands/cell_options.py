"""The command line of `cell`, and the run that it describes."""
# ruff: noqa: PLC0415  heavy imports are local: the nodes start a second earlier

import argparse
from pathlib import Path

from push_core.common import InputError, Parser
from push_core.tracks import TRACKS
from push_gp.models import read_sealed
from push_mpc.settings import CONTROLLERS, PRESETS
from push_node.override_text import parsed_override
from push_sim.settings import PROFILES

from push_bringup.setup import Request

EPILOG = """examples:
  ros2 run push_bringup cell                                   the 8-track at 80 mm/s
  ros2 run push_bringup cell --track square --speed 0.05 --controller analytical
  ros2 run push_bringup cell --mode inprocess -p delay_compensation:=false
  ros2 run push_bringup cell --start here -p start.x:=0.1 -p start.theta:=0.5
  ros2 run push_bringup cell --laps 6 --learn --mode lockstep
  ros2 run push_bringup cell -p mpc_node.weights.contact:=100.0 -o /tmp/runs

The last line printed is the folder of the run: bag, score.json, report.html, logs.
Exit status: 0 the last lap was completed, 1 it was not, 2 the command was wrong, 130 interrupted.
"""


def parser() -> Parser:
    """The command line."""
    parser = Parser('Pushes the square along a track, records the run and scores it.', EPILOG)
    _add_task(parser)
    _add_conditions(parser)
    _add_run(parser)
    return parser


def _add_task(parser: Parser) -> None:
    """What is pushed where, and by which controller."""
    tracks = ', '.join(TRACKS)
    parser.add_argument(
        '--track',
        help=f'{tracks} or a .csv of x, y [m] (default eight)',
    )
    parser.add_argument('--speed', type=float, help='[m/s] (default 0.08)')
    controllers = '; '.join(f'{name}: {kind.text}' for name, kind in CONTROLLERS.items())
    parser.add_argument(
        '--controller',
        choices=tuple(CONTROLLERS),
        help=f'{controllers} (default gp)',
    )
    parser.add_argument(
        '--model',
        type=Path,
        metavar='FILE',
        help='model file for gp; default: a model of 200 simulated pushes, trained once',
    )


def _add_conditions(parser: Parser) -> None:
    """Under which conditions, where it begins, and how often."""
    parser.add_argument(
        '--profile',
        choices=tuple(PROFILES),
        help='lag of the robot and errors of the cameras (default irb120)',
    )
    parser.add_argument(
        '--preset',
        choices=PRESETS,
        help='of the controller; paper: weights and horizon of the paper (default tuned)',
    )
    parser.add_argument(
        '--perturb',
        choices=('none', 'normal', 'tangential'),
        help='at the start; normal: moves the object 30 mm off the pusher, '
        'tangential: moves the pusher 20 mm along the face (default none)',
    )
    parser.add_argument(
        '--start',
        choices=('plan', 'here'),
        help='plan: the object is put at the start of the track; here: the track is moved to '
        'begin where the object lies, in simulation at start.* (default plan)',
    )
    parser.add_argument('--laps', type=int, help='rounds of a closed track (default 1)')
    parser.add_argument(
        '--learn',
        action='store_true',
        help='let each lap teach the next: friction, support radius, shift of the reference',
    )
    parser.add_argument(
        '--learn-from',
        type=Path,
        metavar='RUN',
        help='the same, from what the last lap of a recorded run taught',
    )


def _add_run(parser: Parser) -> None:
    """How the run is made, with which parameters, and where it goes."""
    parser.add_argument('--seed', type=int, help='of all random numbers (default 0)')
    parser.add_argument(
        '--mode',
        choices=('realtime', 'lockstep', 'inprocess'),
        help='realtime: nodes by the wall clock; lockstep: nodes that wait for each other, '
        'repeatable; inprocess: one process without ROS, fastest (default realtime)',
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
        help='ROS parameter file that overrides the defaults, such as that of push_sim calibrate',
    )
    parser.add_argument('--namespace', default='', help='of the node graph')
    parser.add_argument(
        '--watch', action='store_true', help='show modes, errors and the health of the nodes'
    )
    parser.add_argument(
        '-o',
        '--output',
        type=Path,
        default=Path('runs'),
        metavar='DIR',
        help='the run gets a new folder in it (default %(default)s)',
    )


def requested(arguments: argparse.Namespace) -> Request:
    """The run that the arguments describe.

    Raises:
        InputError: an argument is out of range, or two of them contradict each other.
    """
    if arguments.speed is not None and not arguments.speed > 0.0:
        raise InputError(f'--speed is {arguments.speed:g}, must be above 0 m/s')
    if arguments.watch and arguments.mode == 'inprocess':
        raise InputError('--watch has no effect on --mode inprocess, which has no nodes')
    overrides = dict(parsed_override(text) for text in arguments.param)
    return Request(
        track=arguments.track,
        speed=arguments.speed,
        controller=arguments.controller,
        model=_model(arguments.model),
        profile=arguments.profile,
        perturb=arguments.perturb,
        laps=arguments.laps,
        learn=arguments.learn or arguments.learn_from is not None,
        learn_from=arguments.learn_from,
        seed=arguments.seed,
        mode=arguments.mode,
        output=arguments.output,
        namespace=_namespace(arguments.namespace),
        overrides=overrides,
        preset=arguments.preset,
        start=arguments.start,
        watch=arguments.watch,
        params=arguments.params,
    )


def _namespace(text: str) -> str:
    """The name without slashes around it; rclpy is imported only to check one that is given."""
    name = text.strip('/')
    if name:
        from rclpy.exceptions import InvalidNamespaceException
        from rclpy.validate_namespace import validate_namespace

        try:
            validate_namespace(f'/{name}')
        except InvalidNamespaceException:
            raise InputError(f'--namespace {text!r}: takes letters, digits, _ and /') from None
    return name


def _model(path: Path | None) -> str | None:
    """The full path of a model file."""
    if path is None:
        return None
    read_sealed(path)
    return str(path.resolve())
