"""Collects simulated pushes, in several processes."""

import math
from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass
from typing import Any

import numpy as np
from push_core.common import worker_pool
from push_core.data import PushSet
from push_core.geometry import Array
from push_core.physics import Slider
from tqdm import tqdm

from push_sim.collect.collector import Collector
from push_sim.collect.push_design import PushDesign
from push_sim.collect.push_sampling import SAMPLINGS, Sampler
from push_sim.settings import SimSettings, profile

_LARGEST_CHUNK = 250


@dataclass(frozen=True)
class Collection:
    """Everything that determines the rows of a collection."""

    pushes: int
    seed: int
    settings: SimSettings
    design: PushDesign
    sampling: str

    @property
    def sampler(self) -> Sampler:
        """Contact offset and direction of each push."""
        return SAMPLINGS[self.sampling](self.design, Slider().side, self.pushes)


def collect_pushes(
    pushes: int,
    seed: int,
    profile_name: str = 'irb120',
    design: PushDesign | None = None,
    jobs: int = 1,
    sampling: str = 'uniform',
) -> PushSet:
    """Simulates pushes and measures them; the rows do not depend on the number of processes.

    Args:
        pushes: number of pushes.
        seed: seed of contact offsets, directions, start poses and noise; not negative.
        profile_name: profile of the plant; the rows have its measurement noise.
        design: speed and length of the pushes; by default those of the measured ones.
        jobs: number of processes.
        sampling: one of `SAMPLINGS`.

    Raises:
        InputError: the sampling does not allow this number or length of pushes.
        RunError: a push does not stay on the face.
    """
    collection = Collection(pushes, seed, profile(profile_name), design or PushDesign(), sampling)
    table = np.array(list(collected(collection, jobs)))
    return PushSet(table[:, 0], table[:, 1], table[:, 2:], collection.design.distance)


def collected(collection: Collection, jobs: int) -> Iterator[Array]:
    """All rows (5,) in order; an impossible sampling raises before the processes start."""
    _ = collection.sampler
    # making a world takes as long as five pushes
    size = min(_LARGEST_CHUNK, math.ceil(collection.pushes / jobs))
    firsts = range(0, collection.pushes, size)
    tasks = ((collection, first, min(first + size, collection.pushes)) for first in firsts)
    bar: tqdm[Any]
    with (
        tqdm(desc='collecting', total=collection.pushes, unit=' pushes', disable=None) as bar,
        worker_pool(jobs) as pool,
    ):
        for chunk in pool.in_order(_chunk, tasks):
            bar.update(len(chunk))
            yield from chunk


def _chunk(collection: Collection, first: int, end: int) -> list[Array]:
    """The rows of pushes `first` to `end - 1`."""
    parts = collection.settings, Slider(), collection.design, collection.sampler
    with closing(Collector(*parts)) as collector:
        return [collector.push(collection.seed, number) for number in range(first, end)]
