"""All installed solvers return the same first inputs."""

from dataclasses import replace

import numpy as np
import pytest
from push_bringup.commands.bench import main
from push_bringup.comparison.qp_recording import lap_request
from push_bringup.comparison.qp_solvers import IN_SI_UNITS, SOLVERS, exact
from push_bringup.in_process.loop import InProcessCell
from push_bringup.setup.cell_parameters import installed_config, resolved
from push_gp.models.analytical_model import AnalyticalModel
from push_mpc.loop.controller import Mode
from push_mpc.plan.planning import planned
from push_sim.plant.perturbation import Perturbation
from push_sim.settings.plant_settings import PerturbationKind


@pytest.fixture(scope='module', params=['gp', 'analytical'])
def recorded(request):
    """The QPs of 60 ticks with a kick."""
    # the plan costs seconds, and any plan gives such QPs
    flat = {'mpc_node.consistent_plan': False}
    request_of_lap = replace(lap_request(request.param, 'analytical', 0), overrides=flat)
    parameters = resolved(request_of_lap, installed_config('cell.yaml'))
    cell = InProcessCell(parameters, AnalyticalModel(), planned(parameters.mpc))
    ticks = []

    def on_tick(_observation, tick, _tick_ms) -> None:
        if tick.mode == Mode.TRACKING:
            ticks.append(cell.controller.problems)
        if len(ticks) == 30:
            cell.plant.perturb(Perturbation(PerturbationKind.TANGENTIAL, 0.02))
        if len(ticks) == 60:
            cell.controller.stop('enough')

    cell.run(on_tick)
    cell.close()
    return ticks


# OSQP's own defaults stop too early for this: that is what the benchmark shows
@pytest.mark.parametrize('name', [name for name in SOLVERS if name not in IN_SI_UNITS])
def test_a_solver_finds_the_exact_first_inputs(recorded, name) -> None:
    for problems in zip(*recorded, strict=True):
        try:
            solver = SOLVERS[name](problems[0])
        except ImportError:
            pytest.skip(f'{name} is not installed; make setup EXTRA=bench')
        reference = exact(problems[0])
        for problem in problems[::7]:
            variables, _ = solver.solve(problem)
            first = slice(problem.states, problem.states + 2)
            assert np.abs(variables - reference.solve(problem)[0])[first].max() < 0.05  # cm/s


def test_the_qp_in_si_units_is_the_same_qp(recorded) -> None:
    problem = recorded[-1][0]
    again = problem.in_si_units()
    z = np.random.default_rng(0).normal(size=problem.linear.size)
    in_si = z * problem.units[0]
    cost, scaled = (
        0.5 * point @ (each.cost @ point) + each.linear @ point
        for each, point in ((again, in_si), (problem, z))
    )
    assert cost == pytest.approx(problem.units[2] * scaled, rel=1e-12)
    rows = (again.matrix @ in_si) / problem.units[1]
    assert np.allclose(rows, problem.matrix @ z, rtol=0, atol=1e-9)


def test_timing_has_a_help_of_its_own(capsys) -> None:
    with pytest.raises(SystemExit) as ended:
        main(['timing', '--help'])
    assert ended.value.code == 0
    assert 'CPU time' in capsys.readouterr().out
