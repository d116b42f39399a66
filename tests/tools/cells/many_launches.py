"""Launches a cell with every argument and choice, in a row, and ends it at random moments.

Needs the real `ros2 launch`. Of each launch: the output is quiet, no process is left, and the bag
is finished; of one that has started a run, the bag is scored, and recomputed where asked.
"""

import argparse
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from ament_index_python import PackageNotFoundError, get_package_prefix
from launch_command import LINE, Launched, is_quiet
from push_bringup.commands.launch_arguments import ARGUMENTS
from push_core.common import Parser, RunError, run_command
from push_gp.models.model_file import save_model
from push_gp.training.train import train
from push_sim import collect_pushes

DONE = 'stopping -> done'
ARMED = '-> armed'
AUTOSTART = 'autostart:=true'
CHOSEN: dict[str, tuple[str, ...]] = {
    'track': ('eight', 'square', 'line', 'circle', 'arc.csv'),
    'speed': ('0.15',),
    'model': ('model.npz',),
    'laps': ('2',),
    'seed': ('7',),
    'folder': ('named',),
    'namespace': ('left',),
    'params_file': ('params.yaml',),
}
"""Values of the arguments that are no choice."""
WHOLE = ('controller', 'start', 'seed', 'namespace', 'params_file', 'model', 'folder')
"""Arguments with which a whole run is awaited, and computed again."""
PREFIXES = 'AMENT_PREFIX_PATH'
RVIZ = 'lib/rviz2/rviz2'
RVIZ_SCRIPT = """#!/bin/sh
[ "$1" = -d ] && grep -q 'Class: rviz_default_plugins' "$2" || exit 1
trap 'exit 0' INT
while :; do sleep 0.1; done
"""
EPILOG = """
Example: scripts/in_env python tests/tools/cells/many_launches.py --moments 10
"""


@dataclass(frozen=True)
class Case:
    """One launch: its arguments, and when it is interrupted.

    Attributes:
        arguments: `name:=value` each.
        until: text that is awaited; empty for none.
        wait: time [s] before the interrupt.
    """

    arguments: tuple[str, ...]
    until: str = ''
    wait: float = 0.0

    @property
    def words(self) -> str:
        """For people."""
        return f'{" ".join(self.arguments)}, until {self.until or f"{self.wait:.1f} s"}'


def cases_of_arguments() -> list[Case]:
    """One for each value of each argument."""
    values = {each.name: each.choices or CHOSEN[each.name] for each in ARGUMENTS}
    return [_case(name, value) for name, chosen in values.items() for value in chosen]


def _case(name: str, value: str) -> Case:
    given = dict(word.split(':=') for word in (*LINE, AUTOSTART))
    # a model is that of the Gaussian process
    given |= {'model': {'controller': 'gp'}, 'laps': {'track': 'circle'}}.get(name, {})
    given[name] = value
    until = DONE if name in WHOLE else 'as a table' if value == 'false' else '-> tracking'
    return Case(tuple(f'{key}:={text}' for key, text in given.items()), until)


def cases_at_random(count: int, seed: int) -> list[Case]:
    """Interrupts within the first seconds, in both modes."""
    random = np.random.default_rng(seed)
    modes = random.choice(['lockstep', 'realtime'], count)
    lines = [(*LINE[:2], f'mode:={mode}', AUTOSTART) for mode in modes]
    return [Case(line, wait=float(random.uniform(0.0, 15.0))) for line in lines]


def faults_of(case: Case, environment: dict[str, str], folder: Path) -> list[str]:
    """Launches, interrupts, and tells what is not as it should be."""
    cell = Launched(environment, folder, *case.arguments)
    try:
        if case.until:
            cell.wait_for(case.until)
        time.sleep(case.wait)
        cell.press_ctrl_c()
        output = cell.wait()
    finally:
        left = _is_left(cell)
    # before that, ros2 itself imports, and says so
    begun = 'process started' in output
    faults = ['the output is not quiet'] if begun and not is_quiet(output) else []
    faults += ['processes were left'] if left else []
    named = [folder / word.split(':=')[1] for word in case.arguments if word.startswith('folder')]
    for bag in named or cell.bags()[-1:]:
        faults += _faults_of_bag(bag, output, environment)
    return [f'{fault}\n{output}' for fault in faults]


def _is_left(cell: Launched) -> bool:
    """Whether a process of a launch still ran; ends it."""
    try:
        os.killpg(cell.process.pid, signal.SIGKILL)
    except ProcessLookupError:
        return False
    return True


def _faults_of_bag(bag: Path, output: str, environment: dict[str, str]) -> list[str]:
    if not bag.exists():
        # interrupted before the recorder ran, or nothing is recorded
        return ['no bag'] if ARMED in output and 'nothing is recorded' not in output else []
    if not (bag / 'metadata.yaml').is_file():
        return ['the bag is not finished']
    faults = []
    if ARMED in output:
        # of an interrupted run the status is 1
        faults += _faults_of_command(environment, (0, 1), 'score', str(bag))
    if DONE in output:
        faults += _faults_of_command(environment, (0,), 'replay', str(bag), '--recompute')
    return faults


def _faults_of_command(
    environment: dict[str, str], wanted: tuple[int, ...], *words: str
) -> list[str]:
    command = ['ros2', 'run', 'push_bag', *words]
    ended = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    good = ended.returncode in wanted and ended.stdout
    return [] if good else [f'{" ".join(words)}: {ended.stdout[-300:]} {ended.stderr}']


def write_files(folder: Path) -> None:
    """The files that the arguments name."""
    save_model(folder / 'model.npz', train(collect_pushes(30, seed=0)))
    (folder / 'arc.csv').write_text('0,0\n0.1,0.01\n0.2,0.04\n0.3,0.09\n')
    (folder / 'params.yaml').write_text('/**/mpc_node:\n  ros__parameters:\n    speed: 0.1\n')


def with_rviz(environment: dict[str, str], folder: Path) -> dict[str, str]:
    """An environment with an RViz: a script that reads its layout, where no real one is."""
    with suppress(PackageNotFoundError):
        get_package_prefix('rviz2')
        return environment
    prefix = folder / 'rviz_prefix'
    for each in (RVIZ, 'share/ament_index/resource_index/packages/rviz2'):
        (prefix / each).parent.mkdir(parents=True)
        (prefix / each).write_text(RVIZ_SCRIPT)
    (prefix / RVIZ).chmod(0o755)
    return {**environment, PREFIXES: f'{prefix}:{environment[PREFIXES]}'}


def main(argv: Sequence[str] | None = None) -> int:
    """Launches; exit status 1 if something is not as it should be."""
    parser = Parser('Launches a cell in many ways and ends it.', epilog=EPILOG)
    parser.add_argument('--moments', type=int, default=10, help='launches ended at random moments')
    parser.add_argument('--seed', type=int, default=0, help='of the moments')
    parser.add_argument('--only', default='', help='launches whose words hold this text')
    return run_command(parser, _work, argv)


def _work(options: argparse.Namespace) -> None:
    # also where the shell has started this in the background, which ignores Ctrl-C
    signal.signal(signal.SIGINT, signal.default_int_handler)
    cases = [*cases_of_arguments(), *cases_at_random(options.moments, options.seed)]
    cases = [case for case in cases if options.only in case.words]
    failed = 0
    with tempfile.TemporaryDirectory(prefix='push_launches_') as name:
        write_files(Path(name))
        environment = with_rviz(dict(os.environ), Path(name))
        for case in cases:
            try:
                faults = faults_of(case, environment, Path(name))
            except (AssertionError, subprocess.TimeoutExpired) as error:
                faults = [f'it hangs: {error}']
            failed += bool(faults)
            sys.stdout.write(f'{case.words}: {"; ".join(faults) or "clean"}\n')
            sys.stdout.flush()
    if failed:
        raise RunError(f'{failed} of {len(cases)} launches')


if __name__ == '__main__':
    sys.exit(main())
