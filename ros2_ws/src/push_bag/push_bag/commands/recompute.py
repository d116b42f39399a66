"""The options --recompute and --ask of `push_bag replay`."""

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path

import rclpy
from push_core.common import InputError, Parser, write_atomically
from push_node.override_text import parsed_override
from push_node.start_ros import init_ros

from push_bag.replay import Changes, Recomputed, recomputed
from push_bag.replay.node_comparison import compared_with_node


def add_recompute_arguments(parser: Parser) -> None:
    """Adds the options of recomputing."""
    group = parser.add_argument_group('recomputing')
    group.add_argument('--recompute', action='store_true', help='recompute the commands here')
    group.add_argument(
        '--ask', action='store_true', help='recompute them with a running mpc_node, in lockstep'
    )
    group.add_argument(
        '--qp', type=int, metavar='TICK', help='solve the QPs of this tick again, and say more'
    )
    group.add_argument('--controller', metavar='NAME', default='', help='use another controller')
    group.add_argument('--model', type=Path, metavar='FILE', help='use another model file')
    group.add_argument(
        '-p',
        '--param',
        action='append',
        default=[],
        metavar='NAME:=VALUE',
        help='change a parameter, by NAME or NODE.NAME; repeatable',
    )
    group.add_argument('--html', type=Path, metavar='FILE', help='write a figure of both')


def check_recompute_arguments(
    arguments: argparse.Namespace, replaying: Mapping[str, object]
) -> None:
    """Refuses options that would have no effect.

    Args:
        arguments: of the command line.
        replaying: options of publishing, with their defaults.

    Raises:
        InputError: an option has no effect.
    """
    if sum((arguments.recompute, arguments.ask, arguments.qp is not None)) > 1:
        raise InputError('--recompute, --ask and --qp: name one of them')
    if (arguments.controller or arguments.model or arguments.param) and not arguments.recompute:
        raise InputError('--controller, --model and --param need --recompute')
    if arguments.html and not (arguments.recompute or arguments.ask):
        raise InputError('--html needs --recompute or --ask')
    if not (arguments.recompute or arguments.ask or arguments.qp is not None):
        return
    given = vars(arguments)
    for name, default in replaying.items():
        if given[name] != default:
            raise InputError(f'--{name} has no effect on --recompute, --ask and --qp')


def recompute(arguments: argparse.Namespace) -> int:
    """Compares recorded with recomputed commands.

    Returns:
        1 if nothing was changed and a command differs, else 0.

    Raises:
        InputError: the bag lacks what the controller needs, or a change is invalid.
    """
    params = dict(parsed_override(text) for text in arguments.param)
    changes = Changes(arguments.controller, arguments.model, params)
    result = recomputed(arguments.run, changes)
    _write(result, arguments.html)
    return int(not changes.any and not result.same)


def ask(arguments: argparse.Namespace) -> int:
    """Compares recorded commands with those of a running controller.

    Returns:
        1 if a command differs, else 0.

    Raises:
        InputError: the bag lacks poses or ticks.
        RunError: no controller answers.
    """
    # Python keeps handling Ctrl-C, so that it ends the wait for a command
    init_ros()
    try:
        result = compared_with_node(arguments.run, rclpy.create_node('replay'))
    finally:
        rclpy.try_shutdown()
    _write(result, arguments.html)
    return int(not result.same)


def _write(result: Recomputed, page: Path | None) -> None:
    if page is not None:
        # plotly takes a second to import
        from push_bag.replay.command_figure import command_page  # noqa: PLC0415

        write_atomically(page, command_page(result).encode())
    sys.stdout.write(result.text())
