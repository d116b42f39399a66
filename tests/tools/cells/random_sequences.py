"""Random sequences of what users do by hand to a cell in lockstep, and what must hold in each.

Starts, stops, resumes, resets, perturbations, changes of parameters and of the model, and every
node killed and started again, in any order, over DDS. What must hold: the commands and the tip
keep their limits, no tick follows a plan from which the object is more than 50 mm away, `score`
tells of each start what happened in it, and in the end the cell still completes a run.
"""

import argparse
import os
import shutil
import signal
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from graph_by_hand import GraphByHand
from push_core.common import Parser, RunError, run_command
from push_core.physics import MotionCone, Slider
from push_gp.models.model_file import save_model
from push_gp.training.train import train
from push_msgs.msg import ControllerState
from push_msgs.srv import AddPushes, Perturb, Reset
from push_node import interface
from push_node.endpoints import GraphService
from push_sim import collect_pushes
from sequence_checks import Witness, compared

LOCKSTEP = 'mode:=lockstep'
SIGNALS = (signal.SIGKILL, signal.SIGINT, signal.SIGTERM)
NODES = ('sim_node', 'gp_server', 'mpc_node', 'recorder')
MODELS = {'small.npz': 30, 'other.npz': 60}
LONGEST_RUN = 120.0  # [s] on a busy machine; a lap of the line has 340 ticks
SETTINGS: dict[str, dict[str, tuple[float, float]]] = {
    'mpc_node': {
        'weights.position_x': (2000.0, 9000.0),
        'weights.contact': (300.0, 2000.0),
        'force_weights.contact': (10.0, 60.0),
        'limits.speed': (0.12, 0.25),
        'limits.acceleration': (2.0, 5.0),
        'tangential_speed_limit': (0.05, 0.15),
        'disturbance_length': (0.0, 0.1),
        'recontact.gap': (0.0005, 0.005),
        'horizon_length': (0.05, 0.1),
    },
    'sim_node': {
        'world.friction_pusher': (0.1, 0.4),
        'world.friction_ground': (0.2, 0.5),
        'sensor.position_noise': (0.0, 3e-4),
        'sensor.dropout': (0.0, 0.1),
        'command_loss': (0.0, 0.05),
        'world.substep': (0.0005, 0.002),
    },
}
"""Parameters with ranges that reach beyond what is allowed, or that may not change at all."""
EPILOG = """
Example: scripts/in_env python tests/tools/cells/random_sequences.py --seeds 100
"""


class RandomSequence:
    """One sequence.

    Attributes:
        done: what was done, with the answers.
    """

    def __init__(self, seed: int, environment: dict[str, str], folder: Path) -> None:
        """Starts the nodes in a folder that holds the model files."""
        self.done: list[str] = []
        self._random = np.random.default_rng(seed)
        self._graph = GraphByHand(environment, folder)
        self.witness = Witness(self._graph.node)
        self._folder, self._bags = folder, 0
        self._controller = str(self._random.choice(['gp', 'analytical']))
        self._actions: dict[str, tuple[float, Callable[[], str]]] = {
            'begin': (4.0, self._begin),
            'start': (1.0, lambda: self._call(interface.START)),
            'stop': (1.0, lambda: self._call(interface.STOP)),
            'resume': (1.5, lambda: self._call(interface.RESUME)),
            'reset to plan': (0.7, lambda: self._call(interface.RESET_TO_PLAN)),
            'reset': (0.7, self._reset),
            'perturb': (2.0, self._perturb),
            'set': (3.0, self._set),
            'kill': (2.0, self._kill),
            'add pushes': (0.7, self._add_pushes),
        }
        for node in NODES:
            self._start_node(node)

    def run(self, steps: int) -> None:
        """Does a number of random things, then completes a run and ends the nodes.

        Raises:
            RunError: the cell did not complete a run in the end, or a node did not end cleanly.
        """
        weights = np.array([weight for weight, _ in self._actions.values()])
        for _ in range(steps):
            name = str(self._random.choice([*self._actions], p=weights / weights.sum()))
            self._note(name, self._actions[name][1]())
            self._graph.happens(lambda: False, float(self._random.uniform(0.0, 0.5)))
        self._complete_a_run()
        for node in ('mpc_node', 'sim_node', 'gp_server', 'recorder'):
            status = self._graph.end(node)
            if status:
                raise RunError(f'{node} ended with status {status} after Ctrl-C')

    def close(self) -> None:
        """Ends all that runs."""
        self._graph.close()

    def bags(self) -> list[Path]:
        """The recordings, in order."""
        folders = [self._folder / f'run{number}' for number in range(1, self._bags + 1)]
        # a recorder that ended while it started made none
        return [folder for folder in folders if folder.exists()]

    def _note(self, action: str, answer: str) -> None:
        self.done.append(f'{action}: {answer}')

    def _start_node(self, node: str) -> None:
        if node == 'recorder':
            self._bags += 1
            self._graph.start(node, f'folder:=run{self._bags}')
        elif node == 'sim_node':
            self._graph.start(node, LOCKSTEP, f'seed:={self._random.integers(1000)}')
        elif node == 'gp_server':
            self._graph.start(node, f'model:={self._random.choice(["analytical", *MODELS])}')
        else:
            controller = f'controller:={self._controller}'
            self._graph.start(node, LOCKSTEP, 'track:=line', 'speed:=0.15', controller)

    def _call(self, service: GraphService, request: Any = None) -> str:
        """What a service answered."""
        ran = self.witness.is_running()
        answer = self._graph.call(service, request)
        if answer is None:
            return 'no answer'
        # a request that is repeated, because the answer was late, has already started
        armed = 'armed' in answer.message or not ran
        if service is interface.START and answer.success and armed:
            self.witness.armed += 1
            # one that ends before its first tick leaves no trace
            self._graph.happens(self.witness.has_seen_all, LONGEST_RUN)
        return str(answer.message)

    def _begin(self) -> str:
        answers = [self._call(each) for each in (interface.RESUME, interface.RESET_TO_PLAN)]
        return '; '.join([*answers, self._call(interface.START)])

    def _reset(self) -> str:
        pose = self._random.uniform([-0.2, -0.2, -3.0], [0.2, 0.2, 3.0])
        offset, gap = self._random.uniform(-0.04, 0.04), self._random.choice([0.0, 0.02])
        request = Reset.Request(seed=int(self._random.integers(1000)))
        request.object_pose = pose
        request.tip_position = Slider().tip_position(pose, offset, gap)
        return self._call(interface.RESET, request)

    def _perturb(self) -> str:
        kind = int(self._random.integers(3))
        largest = {Perturb.Request().kind: 0.04, 1: 0.03, 2: 0.5}[kind]
        request = Perturb.Request(kind=kind, magnitude=float(self._random.uniform(0.0, largest)))
        request.angle = float(self._random.uniform(-3.0, 3.0))
        return f'kind {kind}, {request.magnitude:.3f}: {self._call(interface.PERTURB, request)}'

    def _set(self) -> str:
        node = str(self._random.choice([*SETTINGS]))
        names = self._random.choice([*SETTINGS[node]], self._random.integers(1, 4), replace=False)
        values = {str(name): float(self._random.uniform(*SETTINGS[node][name])) for name in names}
        return f'{values}: {self._graph.set(node, **values) or "set"}'

    def _kill(self) -> str:
        node = str(self._random.choice(NODES))
        number = SIGNALS[int(self._random.integers(len(SIGNALS)))]
        ready = self._graph.catches(node, signal.SIGTERM)
        # an interpreter that still imports has no handler yet
        fair = (0, 130) if ready else (0, 130, 1, -number)
        status = self._graph.end(node, number)
        if number != signal.SIGKILL and status not in fair:
            raise RunError(f'{node} ended with status {status} after {number.name}')
        self._graph.happens(lambda: False, float(self._random.choice([0.0, 0.5, 3.0])))
        self._start_node(node)
        return f'{node} with {number.name}, started again'

    def _add_pushes(self) -> str:
        p_y, beta = self._random.uniform(-0.03, 0.03, 5), self._random.uniform(1.0, 2.0, 5)
        mean = 0.004 * MotionCone(Slider()).evaluate(p_y, beta)[0]
        request = AddPushes.Request(p_y=p_y.tolist(), beta=beta.tolist(), distance=0.004)
        request.displacement = mean.ravel().tolist()
        return self._call(interface.ADD_PUSHES, request)

    def _complete_a_run(self) -> None:
        """Puts everything in place and starts, as a user would: again if it stops at first.

        A recorder that was killed counts for 2 s, in which a start is accepted.
        """
        if not any(self._completes() for _ in range(3)):
            raise RunError(f'the last start did not complete: {self.witness.last_state()}')
        self._graph.happens(lambda: False, 0.5)  # the recorder writes the last messages

    def _completes(self) -> bool:
        answer = ''
        for _ in range(300):
            answer = self._begin()
            if 'armed' in answer:
                break
            self._graph.happens(lambda: False, 0.1)
        self._note('last start', answer)
        self._graph.happens(lambda: self.witness.outcome is not None, LONGEST_RUN)
        return self.witness.outcome == ControllerState.DONE


def make_models(folder: Path) -> None:
    """Puts the models that the sequences load into a folder."""
    for name, count in MODELS.items():
        if not (folder / name).exists():
            save_model(folder / name, train(collect_pushes(count, seed=count)))


def faults_of(seed: int, steps: int, environment: dict[str, str], folder: Path) -> list[str]:
    """Runs one sequence in a folder with the models; what did not hold, with what was done."""
    sequence = RandomSequence(seed, environment, folder)
    faults: list[str] = []
    try:
        sequence.run(steps)
    except (RunError, AssertionError) as error:
        faults.append(str(error))
    finally:
        sequence.close()
    faults += [*sequence.witness.faults, *sequence.witness.jumps()]
    faults += compared(sequence.bags(), sequence.witness)
    return [*faults, *sequence.done] if faults else []


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the sequences; exit status 1 if something does not hold in one of them."""
    parser = Parser('Runs random sequences of what users do to a cell.', epilog=EPILOG)
    parser.add_argument('--seeds', type=int, default=10, help='how many sequences')
    parser.add_argument('--first', type=int, default=0, help='first seed')
    parser.add_argument('--steps', type=int, default=15, help='things done in each')
    return run_command(parser, _work, argv)


def _work(arguments: argparse.Namespace) -> None:
    environment, failed = dict(os.environ), []
    environment.setdefault('ROS_DOMAIN_ID', '0')
    with tempfile.TemporaryDirectory(prefix='push_models_') as models:
        make_models(Path(models))
        for seed in range(arguments.first, arguments.first + arguments.seeds):
            folder = Path(tempfile.mkdtemp(prefix=f'push_sequence_{seed}_'))
            for name in MODELS:
                (folder / name).write_bytes((Path(models) / name).read_bytes())
            faults = faults_of(seed, arguments.steps, environment, folder)
            sys.stdout.write(f'seed {seed}: {"; ".join(faults[:1]) or "holds"}\n')
            sys.stdout.flush()
            if faults:
                failed.append(seed)
                (folder / 'faults.txt').write_text('\n'.join(faults), encoding='utf-8')
                sys.stdout.write(f'  {folder}/faults.txt\n')
            else:
                shutil.rmtree(folder)
    if failed:
        raise RunError(f'{len(failed)} of {arguments.seeds} sequences: {failed}')


if __name__ == '__main__':
    sys.exit(main())
