"""Recomputes the commands of a recorded run from its poses, with its controller or another one.

The controller gets the recorded inputs of every tick: poses, times, model, starts and stops. The
delay predictor is fed the recorded commands, not the recomputed ones, because those moved the tip.
"""

import math
import tempfile
from collections.abc import Callable, Collection
from dataclasses import replace
from pathlib import Path

import numpy as np
from push_bag.replay import Changes, Recomputed
from push_bag.run import RecordedRun, RecordedTick
from push_core.common import InputError, replaced
from push_core.geometry import Array
from push_gp.models import ANALYTICAL, NOMINAL_DISTANCE, PushModel, model_named
from push_gp.server.conversions import learned_of
from push_mpc.loop import MOVING, Controller, Mode
from push_mpc.node import conversions
from push_mpc.plan import Lesson, planned
from push_mpc.settings import CONTROLLERS
from tqdm import tqdm

from push_bringup.in_process.recorded_model import RecordedModel, recorded_lessons
from push_bringup.in_process.tables import tabulated
from push_bringup.setup import CellParameters, recorded_parameters

PARAMS_FILE = 'params.yaml'
ModelById = Callable[[str], tuple[PushModel, Lesson | None]]
"""Recorded model id, to the model to use in its place, and what laps had taught."""
PlanStart = Callable[[RecordedTick], Array]
"""A tick, to the pose (3,) at which its plan begins."""


def recomputed(path: Path, changes: Changes) -> Recomputed:
    """The recorded and the recomputed commands of a run.

    Args:
        path: run folder or MCAP file.
        changes: differences from the recorded run.

    Raises:
        InputError: the bag lacks parameters, model or track, or a change is not possible.
    """
    run, controller, paired = opened(path, changes)
    return _compared(run, controller, paired)


def opened(path: Path, changes: Changes) -> 'tuple[RecordedRun, RecomputingController, int]':
    """A run, its controller, and the difference of stamps [ns] that pairs two poses.

    Raises:
        InputError: the bag lacks parameters, model or track, or a change is not possible.
    """
    run = RecordedRun(path)
    with tempfile.TemporaryDirectory(prefix='push_recompute_') as scratch:
        files = _unpacked(run, Path(scratch))
        parameters = _parameters(run, changes, files)
        kept = {name.removeprefix('mpc_node.') for name in changes.params}
        models = _models_of(run, parameters, files)
        controller = RecomputingController(parameters, models, run.plan_start, kept)
    return run, controller, round(1e9 * parameters.mpc.poses.pair_tolerance)


class RecomputingController(Controller):
    """A controller that computes commands but predicts with the recorded ones."""

    def __init__(
        self,
        parameters: CellParameters,
        model_by_id: ModelById,
        plan_start: PlanStart,
        kept: Collection[str] = (),
    ) -> None:
        """Plans from the parameters.

        Args:
            parameters: of the cell.
            model_by_id: the model to use where the run used the one of an id.
            plan_start: where the plan began in the run.
            kept: parameters that stay although they changed during the run.
        """
        super().__init__(parameters.mpc, parameters.mpc.slider, planned(parameters.mpc))
        self._side = parameters.mpc.slider.side
        self._kept = kept
        self._model_by_id = model_by_id
        self._plan_start = plan_start if parameters.mpc.start_from == 'here' else None
        self._recorded_id = ''
        self._recorded_command: Array | None = None

    def command_at(self, tick: RecordedTick) -> Array | None:
        """The command at a recorded tick (2,) [m/s]; None where a pose is missing."""
        velocity = self.answer(tick)
        if velocity is not None:
            self.prepare_next()
        return velocity

    def answer(self, tick: RecordedTick) -> Array | None:
        """The same, without preparing the next tick: `problems` are those of this one."""
        self._prepare_for(tick)
        self._recorded_command = tick.velocity
        if math.isnan(tick.exposure):
            return self._without_poses(tick)
        if tick.object_pose is None or tick.tip is None:
            return None
        return self.step(tick.object_pose, tick.tip, tick.exposure, tick.now).velocity

    def _remember(self, velocity: Array, now: float) -> None:
        super()._remember(
            velocity if self._recorded_command is None else self._recorded_command, now
        )

    def _prepare_for(self, tick: RecordedTick) -> None:
        """Takes the model and starts where the recorded controller did."""
        changes = {name: tick.changes[name] for name in tick.changes if name not in self._kept}
        if changes:
            self.change(replaced(self.settings, changes))
        if tick.model_id != self._recorded_id:
            self._take_model(tick.model_id)
        begins = tick.mode == Mode.ARMED and self.mode != Mode.ARMED
        if begins and self.mode in (*MOVING, Mode.STOPPING):
            # with other settings the run may not have ended where the recorded one did
            self._sent = np.zeros(2)
            self.stop('started again')
        if begins or tick.mode == Mode.IDLE:
            self.resume()
        if begins:
            self.arm(self._plan_start(tick) if self._plan_start else None)

    def _take_model(self, recorded_id: str) -> None:
        model, lesson = self._model_by_id(recorded_id)
        table = tabulated(model, self._side)
        self.use(self.prepare_model(table, recorded_id, lesson))
        self._recorded_id = recorded_id

    def _without_poses(self, tick: RecordedTick) -> Array:
        if tick.stop_reason:
            self.stop(tick.stop_reason)
        go_on = self.hold if tick.mode == Mode.HOLDING else self.coast
        return go_on(tick.now).velocity


def _compared(run: RecordedRun, controller: RecomputingController, paired: int) -> Recomputed:
    stamps, recorded, computed, skipped = [], [], [], 0
    ticks = run.ticks(paired)
    for tick in tqdm(ticks, total=len(run), unit='tick', desc='recomputing', disable=None):
        velocity = controller.command_at(tick)
        if tick.velocity is None or tick.mode == Mode.IDLE:
            continue
        if velocity is None:
            skipped += 1
            continue
        stamps.append(tick.stamp)
        recorded.append(tick.velocity)
        computed.append(np.array(velocity))
    return Recomputed(
        np.array(stamps, np.int64),
        np.array(recorded, np.float64).reshape(-1, 2),
        np.array(computed, np.float64).reshape(-1, 2),
        skipped,
    )


def _models_of(run: RecordedRun, parameters: CellParameters, files: dict[str, Path]) -> ModelById:
    """The recorded model as it was at that time; or the model that the changes name."""
    model = model_named(parameters.gp.model, parameters.gp.slider)
    if parameters.gp != _parameters(run, Changes(), files).gp:
        return lambda _recorded_id: (model, None)
    grown = RecordedModel(model, parameters.gp.max_points, run.reader)
    lessons = {each.lesson_id: each for each in recorded_lessons(run.reader)}

    def driven(recorded_id: str) -> tuple[PushModel, Lesson | None]:
        if recorded_id not in lessons:
            return grown.grown_to(recorded_id), None
        message = lessons[recorded_id]
        learned = learned_of(message, parameters.gp.slider, NOMINAL_DISTANCE)
        used = learned.model or grown.grown_to(message.model_id)
        return used, conversions.lesson_of(message, parameters.mpc)

    return driven


def _unpacked(run: RecordedRun, folder: Path) -> dict[str, Path]:
    """The attachments as files, by name."""
    files = {}
    for each in run.reader.attached:
        path = folder / Path(each.name).name
        with path.open('wb') as stream:
            stream.writelines(each.blocks())
        files[path.name] = path
    return files


def _parameters(run: RecordedRun, changes: Changes, files: dict[str, Path]) -> CellParameters:
    """The parameters of the run with the changes and the paths of its unpacked files."""
    if PARAMS_FILE not in files:
        raise InputError(f'{run.reader.path} holds no {PARAMS_FILE}, so its controller is unknown')
    text = files[PARAMS_FILE].read_text(encoding='utf-8')
    overrides = dict(changes.params)
    if changes.controller:
        overrides['mpc_node.controller'] = changes.controller
    parameters = recorded_parameters(text, overrides)
    track = files.get(Path(parameters.mpc.track).name, parameters.mpc.track)
    return replace(
        parameters,
        gp=replace(parameters.gp, model=_model(parameters.gp.model, changes, files)),
        mpc=replace(parameters.mpc, track=str(track)),
    )


def _model(recorded: str, changes: Changes, files: dict[str, Path]) -> str:
    """Name of the model: that of the changes, of the changed controller, or of the run."""
    if changes.model is not None:
        return str(changes.model)
    if changes.controller and not CONTROLLERS[changes.controller].trained_model:
        return ANALYTICAL
    if changes.controller and recorded == ANALYTICAL:
        raise InputError(f'name a model file for --controller {changes.controller} with --model')
    return str(files.get(Path(recorded).name, recorded))
