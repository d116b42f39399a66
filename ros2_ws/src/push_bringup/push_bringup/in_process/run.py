"""`cell --mode inprocess`: a recorded run in one process."""

from push_bag.record.recorder import open_bag
from push_gp.models import PushModel
from push_mpc.loop import Tick
from push_mpc.plan import Plan
from push_sim.plant import Observation
from tqdm import tqdm

from push_bringup.in_process.loop import InProcessCell
from push_bringup.in_process.record import InProcessRecord
from push_bringup.setup import CellParameters


def recorded_in_process(parameters: CellParameters, model: PushModel, plan: Plan) -> str:
    """Pushes once along the track and records it.

    Returns:
        Reason of an early stop, else an empty string.

    Raises:
        RunError: the bag cannot be written.
    """
    cell = InProcessCell(parameters, model, plan, parameters.mpc.learn)
    cell.start()
    duration = cell.controller.plan.duration
    with (
        open_bag(parameters.recorder) as writer,
        tqdm(total=round(duration, 2), unit='s', desc='pushing', disable=None) as bar,
    ):
        record = InProcessRecord(writer, cell.plant, cell.controller)
        record.head(parameters.mpc, model.info)

        def taught() -> None:
            if cell.school is not None:
                record.lessons(cell.school.messages, cell.school.models)

        def on_tick(observation: Observation | None, tick: Tick, tick_ms: float) -> None:
            taught()
            record.tick(observation, tick, tick_ms)
            bar.update(min(max(tick.reference_time, bar.n), duration) - bar.n)

        try:
            reason = cell.run(on_tick)
            taught()
            return reason
        finally:
            cell.close()
