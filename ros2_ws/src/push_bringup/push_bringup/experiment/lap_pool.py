"""Many laps on all cores, with a progress bar; finished laps are kept in a file.

Every finished lap is appended to the file at once, so that an interrupted benchmark continues
where it stopped. A lap is looked up by the hash of its job, which includes the sources, the
library versions and the model; laps of other sources stay in the file unused.
"""

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from push_core.common import InputError, worker_pool
from tqdm import tqdm

from push_bringup.experiment.experiment import LapJob
from push_bringup.experiment.lap import Lap, pushed


class LapStore:
    """A file of finished laps, one JSON object a line."""

    def __init__(self, path: Path, fresh: bool = False) -> None:
        """Reads the file.

        Args:
            path: of the file; created if missing.
            fresh: whether to clear it.

        Raises:
            InputError: the file cannot be read or written.
        """
        self._path = path
        self._laps: dict[str, Lap] = {}
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.open('w' if fresh else 'a', encoding='utf-8').close()
            text = path.read_text(encoding='utf-8', errors='replace')
        except OSError as error:
            raise InputError(f'cannot write {path}: {error.strerror}') from error
        self._is_torn = bool(text) and not text.endswith('\n')
        for line in text.splitlines():
            self._take(line)

    def find(self, job: LapJob) -> Lap | None:
        """The lap, if the same code pushed it before."""
        return self._laps.get(job.key)

    def add(self, job: LapJob, lap: Lap) -> None:
        """Adds a lap, in memory and on disk."""
        self._laps[job.key] = lap
        line = json.dumps({'key': job.key, 'lap': asdict(lap)}, separators=(',', ':'))
        with self._path.open('a', encoding='utf-8') as file:
            # a killed process may have left half a line
            file.write(f'\n{line}\n' if self._is_torn else f'{line}\n')
        self._is_torn = False

    def _take(self, line: str) -> None:
        try:
            entry = json.loads(line)
            self._laps[entry['key']] = Lap.from_json(entry['lap'])
        except (ValueError, KeyError, TypeError):
            # half a line of a killed process
            return


def push_all(jobs: Sequence[LapJob], store: LapStore, processes: int) -> list[Lap]:
    """The laps of the jobs, in their order.

    Args:
        jobs: pushed unless the store has them.
        store: gets each lap as soon as it is done.
        processes: that push at the same time.

    Raises:
        InputError: a job cannot be run.
    """
    left = [job for job in jobs if store.find(job) is None]
    _push_missing(left, len(jobs), store, processes)
    done = [store.find(job) for job in jobs]
    return [lap for lap in done if lap is not None]


def _push_missing(left: Sequence[LapJob], total: int, store: LapStore, processes: int) -> None:
    if not left:
        return
    with tqdm(total=total, desc='pushing', unit=' laps', disable=None) as bar:
        bar.update(total - len(left))
        with worker_pool(processes) as pool:
            for number, lap in pool.as_done(_push, list(enumerate(left))):
                store.add(left[number], lap)
                bar.update()


def _push(number: int, job: LapJob) -> tuple[int, Lap]:
    return number, pushed(job)
