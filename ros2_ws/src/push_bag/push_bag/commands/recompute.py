"""`push_bag replay RUN --recompute`: its arguments, and what it says."""

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path

import rclpy
from push_core.common import InputError, Parser, write_atomically
from push_node.override_text import parsed_override
from rclpy.signals import SignalHandlerOptions

from push_bag.replay import Changes, Recomputed, recomputed
from push_bag.replay.node_comparison import interviewed


def add_recompute_arguments(parser: Parser) -> None:
    """Adds what `recompute` reads."""
    group = parser.add_argument_group('recomputing')
    group.add_argument('--recompute', action='store_true', help='compute the commands again')
    group.add_argument(
        '--ask', action='store_true', help='have a running mpc_node compute them, in lockstep'
    )
    group.add_argument('--controller', metavar='NAME', default='', help='another controller')
    group.add_argument('--model', type=Path, metavar='FILE', help='another model file')
    group.add_argument(
        '-p',
        '--param',
        action='append',
        default=[],
        metavar='NAME:=VALUE',
        help='another value of a parameter, as NAME or NODE.NAME; repeatable',
    )
    group.add_argument('--html', type=Path, metavar='FILE', help='draw both over time')


def check_recompute_arguments(
    arguments: argparse.Namespace, replaying: Mapping[str, object]
) -> None:
    """Refuses what would have no effect.

    Args:
        arguments: of the command line.
        replaying: those that only a replay heeds, with their defaults.

    Raises:
        InputError: names it.
    """
    if arguments.recompute and arguments.ask:
        raise InputError('--recompute and --ask: name one of them')
    if (arguments.controller or arguments.model or arguments.param) and not arguments.recompute:
        raise InputError('--controller, --model and --param need --recompute')
    if not (arguments.recompute or arguments.ask):
        if arguments.html:
            raise InputError('--html needs --recompute or --ask')
        return
    given = vars(arguments)
    for name, default in replaying.items():
        if given[name] != default:
            raise InputError(f'--{name} has no effect on --recompute and --ask')


def recompute(arguments: argparse.Namespace) -> int:
    """Compares recorded with recomputed commands.

    Returns:
        1 if nothing was changed and yet a command differs, else 0.

    Raises:
        InputError: the bag lacks what the controller needs, or a change is not possible.
    """
    params = dict(parsed_override(text) for text in arguments.param)
    changes = Changes(arguments.controller, arguments.model, params)
    found = recomputed(arguments.run, changes)
    _tell(found, arguments.html)
    return int(not changes.any and not found.same)


def ask(arguments: argparse.Namespace) -> int:
    """Compares recorded commands with those of a running controller.

    Returns:
        1 if a command differs, else 0.

    Raises:
        InputError: the bag lacks poses or ticks.
        RunError: no controller answers.
    """
    # Ctrl-C stays Python's: it ends the wait for an answer
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    try:
        found = interviewed(arguments.run, rclpy.create_node('replay'))
    finally:
        rclpy.try_shutdown()
    _tell(found, arguments.html)
    return int(not found.same)


def _tell(found: Recomputed, page: Path | None) -> None:
    if page is not None:
        # plotly takes a second to import: only who asks for a figure waits for it
        from push_bag.replay.command_figure import command_page  # noqa: PLC0415

        write_atomically(page, command_page(found).encode())
    sys.stdout.write(found.text())
