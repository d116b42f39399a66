"""`bench model`: our Gaussian processes compared with those of two public libraries."""

import argparse
import importlib.util
import multiprocessing
import resource
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np
from push_core.common import InputError, Parser, RunError, run_command
from push_core.data import PushSet, accuracy, read_checked_pushes
from push_gp.models import nested_rows
from tqdm import tqdm

from push_bringup.bench.options import print_results
from push_bringup.bench.rows import LibraryRow
from push_bringup.comparison import LibraryFit, fit_gpytorch, fit_ours, fit_scikit_learn

LIBRARIES: dict[str, tuple[str, Callable[[PushSet], LibraryFit]]] = {
    'push_gp': ('push_gp', fit_ours),
    'scikit-learn': ('sklearn', fit_scikit_learn),
    'GPyTorch': ('gpytorch', fit_gpytorch),
}
HORIZON = 35
REPEATS = 30
HELD_OUT = 500
EPILOG = """Each library runs in its own process, on one thread. 'make setup EXTRA=bench' installs
them; those that are not installed are left out. The JSON object holds `rivals`.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the comparison."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser('Compares our Gaussian processes with those of public libraries.', EPILOG)
    described.prog = 'bench model'
    described.add_argument('data', type=Path, help='CSV file of pushes')
    described.add_argument('--points', type=int, default=500, help='to train on (default 500)')
    described.add_argument('--seed', type=int, default=0, help='of the choice of pushes')
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    return described


def work(arguments: argparse.Namespace) -> None:
    """Fits with every installed library and prints the comparison.

    Raises:
        InputError: the file or the number of points is wrong.
    """
    pushes = read_checked_pushes(arguments.data)
    if not 1 <= arguments.points <= len(pushes) - 2 or arguments.seed < 0:
        raise InputError(
            f'cannot train on {arguments.points} of {len(pushes)} pushes and hold some out; '
            'choose fewer --points and a --seed from 0'
        )
    order = nested_rows(pushes, len(pushes), arguments.seed)
    training = pushes.take(order[: arguments.points])
    rest = pushes.take(order[arguments.points :][:HELD_OUT])
    rows = [asdict(row) for row in _rows(training, rest)]
    print_results(arguments, 'model', {'points': len(training), 'rivals': rows})


def _rows(training: PushSet, rest: PushSet) -> Iterator[LibraryRow]:
    spawn = multiprocessing.get_context('spawn')
    for name in tqdm(LIBRARIES, desc='comparing', disable=None):
        if importlib.util.find_spec(LIBRARIES[name][0]) is None:
            sys.stderr.write(f"{name} is not installed: 'make setup EXTRA=bench' does it\n")
            continue
        receiver, sender = spawn.Pipe(duplex=False)
        process = spawn.Process(target=_run, args=(name, training, rest, sender))
        process.start()
        sender.close()
        try:
            yield receiver.recv()
        except EOFError:
            raise RunError(f'{name} ended without a result; see above') from None
        finally:
            process.join()


def _run(name: str, training: PushSet, rest: PushSet, sender: object) -> None:
    """Fits and measures one library, in a process of its own."""
    module, fit = LIBRARIES[name]
    importlib.import_module(module)
    # the first fit also imports and compiles
    fit(training.take(np.arange(min(10, len(training)))))
    before, started = _peak_mb(), time.process_time()
    fitted = fit(training)
    seconds, memory = time.process_time() - started, _peak_mb() - before
    queries = rest.inputs[np.arange(HORIZON) % len(rest)]
    predicted, _ = fitted.predict(rest.inputs)
    sender.send(  # type: ignore[attr-defined]
        LibraryRow(
            name,
            seconds,
            _milliseconds(fitted, queries),
            memory,
            fitted.log_likelihood(training),
            float(accuracy(predicted, rest).nmse_push_frame.mean()),
        )
    )


def _milliseconds(fitted: LibraryFit, queries: np.ndarray) -> float:
    durations = []
    for _ in range(REPEATS):
        started = time.perf_counter()
        fitted.predict(queries)
        durations.append(time.perf_counter() - started)
    return 1e3 * float(np.median(durations))


def _peak_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


if __name__ == '__main__':
    sys.exit(main())
