"""What `cell` is asked to do."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class Request:
    """One run of the cell; what is None is left to parameter file and defaults.

    Attributes:
        track: eight, square, line or the path of a CSV file.
        speed: of the object's centre [m/s].
        controller: its name.
        model: path of a model file, or 'analytical'.
        profile: irb120, ideal, harsh or webcam.
        perturb: none, normal or tangential.
        laps: rounds of a closed track.
        learn: whether each lap teaches the next.
        learn_from: run whose last lap has taught.
        seed: of everything random.
        mode: realtime, lockstep or inprocess.
        preset: tuned or paper, for the controller.
        start: plan or here.
        output: folder in which the run's own folder is made.
        namespace: of the node graph, '' for none.
        overrides: further parameters, by name or by node.name.
        params: parameter file that overrides that of the cell.
        watch: whether to show a view of the running nodes.
    """

    track: str | None = None
    speed: float | None = None
    controller: str | None = None
    model: str | None = None
    profile: str | None = None
    perturb: str | None = None
    laps: int | None = None
    learn: bool = False
    learn_from: Path | None = None
    seed: int | None = None
    mode: str | None = None
    preset: str | None = None
    start: str | None = None
    output: Path = Path('runs')
    namespace: str = ''
    overrides: Mapping[str, object] = field(default_factory=dict)
    params: Path | None = None
    watch: bool = False

    @property
    def is_in_process(self) -> bool:
        """Whether it runs without nodes."""
        return self.mode == 'inprocess'
