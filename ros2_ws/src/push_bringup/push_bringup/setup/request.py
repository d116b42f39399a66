"""What `cell` is asked to do."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Request:
    """One run of the cell.

    Attributes:
        track: eight, square, line or the path of a CSV file.
        speed: of the object's centre [m/s].
        controller: its name.
        model: path of a model file, or 'analytical'.
        profile: irb120, ideal or harsh.
        perturb: none, normal or tangential.
        laps: rounds of a closed track.
        seed: of everything random.
        mode: realtime, lockstep or inprocess.
        output: folder in which the run's own folder is made.
        namespace: of the node graph, '' for none.
        preset: tuned or paper, for the controller.
        overrides: further parameters, by name or by node.name.
        params: parameter file that overrides that of the cell, or None.
    """

    track: str
    speed: float
    controller: str
    model: str
    profile: str
    perturb: str
    laps: int
    seed: int
    mode: str
    output: Path
    namespace: str
    overrides: dict[str, object]
    params: Path | None = None
    preset: str = 'tuned'
