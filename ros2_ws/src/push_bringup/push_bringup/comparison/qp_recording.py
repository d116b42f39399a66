"""Records the QPs of a lap with perturbations, tick by tick."""

from pathlib import Path

from push_gp.models import model_named
from push_mpc.loop import Mode, Tick
from push_mpc.plan import planned
from push_mpc.qp import Problem
from push_sim.plant import Observation, Perturbation, PerturbationKind
from tqdm import tqdm

from push_bringup.in_process import InProcessCell
from push_bringup.setup import Request, installed_config, resolved

KICK_PERIOD = 4.0  # [s]
KICKS = (
    Perturbation(PerturbationKind.TANGENTIAL, 0.02),
    Perturbation(PerturbationKind.NORMAL, 0.03),
    Perturbation(PerturbationKind.TANGENTIAL, -0.02),
    Perturbation(PerturbationKind.IMPULSE, 0.1, 1.0),
)


def recorded_problems(controller: str, model: str, seed: int) -> list[tuple[Problem, ...]]:
    """The QPs that the controller solved in each tick of the 8-track at 80 mm/s.

    Args:
        controller: its name.
        model: path of the model file, or 'analytical'.
        seed: of the plant's noise.
    """
    request = lap_request(controller, model, seed)
    parameters = resolved(request, installed_config('cell.yaml'))
    model_of_object = model_named(model, parameters.gp.slider)
    cell = InProcessCell(parameters, model_of_object, planned(parameters.mpc))
    problems: list[tuple[Problem, ...]] = []
    with tqdm(total=cell.controller.plan.time.size, desc='recording', disable=None) as bar:

        def on_tick(_observation: Observation | None, tick: Tick, _tick_ms: float) -> None:
            if tick.mode == Mode.TRACKING:
                problems.append(cell.controller.problems)
                _kick(cell, len(problems))
                bar.update()

        try:
            cell.run(on_tick)
        finally:
            cell.close()
    return problems


def lap_request(controller: str, model: str, seed: int) -> Request:
    """A run of the 8-track at 80 mm/s in process."""
    return Request(
        track='eight',
        speed=0.08,
        controller=controller,
        model=model,
        profile='irb120',
        perturb='none',
        laps=1,
        seed=seed,
        mode='inprocess',
        output=Path(),
        namespace='',
        overrides={},
    )


def _kick(cell: InProcessCell, tick: int) -> None:
    count, rest = divmod(tick, round(KICK_PERIOD / cell.controller.settings.period))
    if rest == 0:
        cell.plant.perturb(KICKS[count % len(KICKS)])
