"""Runs the property tests of limiter, pose gate and modes with many more examples."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from push_core.common import Parser, run_command

SOURCES = Path(__file__).parents[3] / 'ros2_ws' / 'src'
TESTS = (
    'push_core/test/test_safety.py',
    'push_mpc/test/test_pose_gate.py',
    'push_mpc/test/test_modes.py',
)
EPILOG = """
Example: scripts/in_env python tests/tools/random_input/many_examples.py --examples 100000
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs them."""
    parser = Parser(description=__doc__, epilog=EPILOG)
    parser.add_argument('--examples', type=int, default=100_000, help='of each property')
    parser.add_argument('--only', default='', help='expression of pytest that selects tests')
    return run_command(parser, work, argv)


def work(arguments: argparse.Namespace) -> int:
    """Runs pytest with a profile of that many examples; returns its status."""
    settings.register_profile(
        'many', max_examples=arguments.examples, deadline=None, suppress_health_check=HealthCheck
    )
    settings.load_profile('many')
    chosen = ['-k', arguments.only] if arguments.only else []
    files = [str(SOURCES / each) for each in TESTS]
    return int(pytest.main(['-p', 'no:cacheprovider', '--durations=0', *chosen, *files]))


if __name__ == '__main__':
    sys.exit(main())
