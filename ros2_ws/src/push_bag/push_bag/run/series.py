"""The time series of a run as arrays, for score and report.

Stamps and publish times are int64 nanoseconds, so that commands match their poses exactly; all
else is in SI units. Of messages with equal stamps (a waiting simulator repeats its pose) the first
one counts.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from push_msgs.msg import ControllerState

from push_bag.file import Record, Traffic
from push_bag.run.parameter_changes import ParameterChange

Floats = NDArray[np.float64]
Nanoseconds = NDArray[np.int64]
NEVER = 2**63 - 1  # a time [ns] after all others

PAIRED = 5_000_000  # [ns] between the stamps of two poses of the same time


@dataclass(frozen=True)
class Stamped:
    """Values of one topic, ordered by stamp.

    Attributes:
        stamp: (n,) of the messages' headers [ns], strictly increasing.
        published: (n,) publish times [ns].
        values: (n, k); columns and units as `RunSeries` states them.
    """

    stamp: Nanoseconds
    published: Nanoseconds
    values: Floats

    def rows(self, chosen: slice | NDArray[np.intp] | NDArray[np.bool_]) -> 'Stamped':
        """The rows with these indices."""
        return Stamped(self.stamp[chosen], self.published[chosen], self.values[chosen])

    def by_stamp(self) -> 'Stamped':
        """The rows ordered by stamp; of rows with equal stamps the first one."""
        return self.rows(np.unique(self.stamp, return_index=True)[1])

    def at(self, stamps: Nanoseconds) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
        """Indices (m,) of messages with these stamps (m,), and whether each exists (m,)."""
        if not self.stamp.size:
            return np.zeros(stamps.size, np.intp), np.zeros(stamps.size, np.bool_)
        index = np.minimum(np.searchsorted(self.stamp, stamps), self.stamp.size - 1)
        return index, self.stamp[index] == stamps

    def near(self, stamps: Nanoseconds) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
        """Indices (m,) of the messages nearest to stamps (m,), and whether each is near enough.

        Tip and object may be measured at times of their own, up to `PAIRED` apart.
        """
        after, exists = self.at(stamps)
        if not self.stamp.size:
            return after, exists
        before = np.maximum(after - 1, 0)
        earlier = np.abs(stamps - self.stamp[before]) < np.abs(self.stamp[after] - stamps)
        index = np.where(earlier, before, after)
        return index, np.abs(self.stamp[index] - stamps) <= PAIRED


@dataclass(frozen=True)
class Reference:
    """The timed reference of a run.

    Attributes:
        track, controller, speed, side, tip_radius, laps: as in NominalTrajectory.
        time: (n,) [s], equally spaced from 0.
        pose: (n, 3) of the object [m, m, rad], heading continuous.
        p_y: (n,) contact offset [m].
        input: (n, 2) pusher velocity [v_n, v_t] in the body frame [m/s].
    """

    track: str
    controller: str
    speed: float
    side: float
    tip_radius: float
    laps: int
    time: Floats
    pose: Floats
    p_y: Floats
    input: Floats

    @property
    def duration(self) -> float:
        """Duration [s]."""
        return float(self.time[-1])

    def pose_at(self, time: Floats) -> Floats:
        """Reference pose (n, 3) at reference times (n,) [s], linear between samples."""
        columns = [np.interp(time, self.time, column) for column in self.pose.T]
        return np.stack(columns, axis=1)


@dataclass(frozen=True)
class ModelFacts:
    """The model in use: its training size, hash and kind."""

    points: int
    hash: str
    kind: str


@dataclass(frozen=True)
class DrivenLesson:
    """What laps had taught and ticks were driven with.

    Attributes:
        since: stamp of the first of these ticks [ns].
        pushes: that friction and support radius were identified from; 0 if they were not.
        friction: between object and tip, and its standard deviation.
        support_radius: [m], likewise.
        shift: (n, 2) of the reference [m] at every sample of a lap, in the frame of its first
            pose; (0, 2) for none.
    """

    since: int
    pushes: int
    friction: tuple[float, float]
    support_radius: tuple[float, float]
    shift: Floats


@dataclass(frozen=True)
class PerturbationEvent:
    """A perturbation: stamp [ns], kind as in Perturbation.msg, magnitude [m or N s]."""

    stamp: int
    kind: int
    magnitude: float


# modes in which reference time advances
FOLLOWING = (ControllerState.TRACKING, ControllerState.RECONTACT)
# columns of `RunSeries.states`
STATE_COLUMNS = (
    'mode',
    'reference_time',
    'p_y',
    'v_n',
    'v_t',
    'nominal_v_n',
    'nominal_v_t',
    'solve_ms',
    'tick_ms',
    'iterations',
    'solver_status',
    'limited',
    'tick',
    'predicted_x',
    'predicted_y',
    'predicted_reference_x',
    'predicted_reference_y',
    'disturbance_x',
    'disturbance_y',
    'disturbance_theta',
    'innovation_x',
    'innovation_y',
    'innovation_theta',
    'innovation_deviation_x',
    'innovation_deviation_y',
    'innovation_deviation_theta',
)


@dataclass(frozen=True)
class RunSeries:
    """One run, decoded.

    Attributes:
        facts: of the run, as recorded.
        finished: whether the bag has its footer.
        traffic: message counts by topic.
        types: names of the message types by topic.
        object: pose (n, 3) of the square [m, m, rad]; the heading is NaN where the orientation
            is no rotation about z.
        truth: true pose (n, 3) of the square [m, m, rad]; empty where none was recorded.
        pusher: position (n, 2) of the tip [m].
        commands: velocity (n, 2) in the world frame [m/s].
        states: (n, len(STATE_COLUMNS)) of the controller's ticks, see `state`.
        stop_reason: why the cell ended the run early, else why the controller stopped last; empty
            if neither is recorded.
        foreign_commands: number of commands that answer no tick of the controller.
        reference: None where none was recorded.
        model: None where none was recorded.
        lessons: that drove the run, in order; empty where nothing is learned.
        perturbations: in order.
        horizons: planned paths, not decoded; see `Horizons`.
        changes: of the nodes' parameters until the end of the run.
    """

    facts: Mapping[str, str]
    finished: bool
    traffic: Mapping[str, Traffic]
    types: Mapping[str, str]
    object: Stamped
    truth: Stamped
    pusher: Stamped
    commands: Stamped
    states: Stamped
    stop_reason: str
    foreign_commands: int
    reference: Reference | None
    model: ModelFacts | None
    lessons: tuple[DrivenLesson, ...]
    perturbations: tuple[PerturbationEvent, ...]
    horizons: tuple[Record, ...]
    changes: tuple[ParameterChange, ...]

    def state(self, name: str) -> Floats:
        """The column (n,) of `states` with this name, see STATE_COLUMNS."""
        return self.states.values[:, STATE_COLUMNS.index(name)]

    @property
    def following(self) -> NDArray[np.bool_]:
        """Whether reference time advanced in each of the controller's ticks (n,)."""
        return np.isin(self.state('mode'), FOLLOWING)
