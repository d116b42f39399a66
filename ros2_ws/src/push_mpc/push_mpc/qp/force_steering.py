"""The analytical controller: the Family of Modes over [f_n, f_t, slip].

A contact sticks, slides left or slides right, and each mode has linear constraints of its own.
Three QPs are solved in every tick: the contact sticks in all stages, or it slides left or right in
the first stage and sticks in the others. The solution with the lowest cost is used. Source: Hogan
and Rodriguez 2016, section 5.
"""

from dataclasses import replace

import numpy as np
from push_core.geometry import Array
from push_core.physics import ContactMode, LimitSurface, Slider

from push_mpc.motion import ContactForce, TabulatedModel, TravelMotion
from push_mpc.plan import Plan
from push_mpc.qp.iteration import RealTimeIteration
from push_mpc.qp.solution import Solution
from push_mpc.qp.stages import InputSpace, Stages
from push_mpc.qp.steady_shift import steady_shift
from push_mpc.qp.steering import Move, StagedPlan, contact_after, mean_over_steps
from push_mpc.qp.tracking_qp import QPWeights, TrackingQP
from push_mpc.settings import ControllerSettings

FAMILY = (ContactMode.STICKING, ContactMode.SLIDING_LEFT, ContactMode.SLIDING_RIGHT)
_SOLVED = 1
_SPEED = 1e-2  # [m/s]; the solver's unit of the slip, and of the speed that a force makes


class ForceSteering:
    """See `Steering`; one QP for each mode of `FAMILY`.

    Attributes:
        mode: contact mode in the first stage of the latest solution.
    """

    solvers: tuple[TrackingQP, ...]

    def __init__(self, settings: ControllerSettings, slider: Slider, _speed: float) -> None:
        self._settings = settings
        self._motion = ContactForce(slider)
        self._space = _space(slider)
        self.mode = ContactMode.STICKING
        weights = _weights(settings, self._space)
        self.solvers = tuple(
            TrackingQP(settings.horizon_steps, self._space, weights) for _ in FAMILY
        )
        self._iteration = RealTimeIteration(
            settings.horizon_steps, self._space.size, relinearise=False
        )

    def staged(self, model: TabulatedModel, plan: Plan, stride: int, slider: Slider) -> StagedPlan:
        """See `Steering.staged`.

        The derivatives are those of the slider's limit surface, the motion along the plan is the
        model's: the estimate of the model error is relative to the latter.
        """
        motion = ContactForce(slider)
        forces = replace(plan, input=motion.of_velocity(plan.state[:, 3], plan.input))
        rates = TravelMotion(model, slider.tip_x).rates(plan.state, plan.input)
        excess = rates - motion.rates(forces.state, forces.input)
        contact, mean = contact_after(plan, stride), mean_over_steps(forces.input, stride)
        target, space = steady_shift(motion, forces), _space(slider)
        limits = [_limits(self._settings, motion, contact, mean, mode) for mode in FAMILY]
        stages = tuple(Stages.of(space, target, each) for each in limits)
        excess = mean_over_steps(excess, stride)
        return StagedPlan(forces, motion, stride, contact, mean, excess, stages)

    def take(self, slider: Slider) -> None:
        """See `Steering.take`."""
        if slider == self._motion.slider:
            return
        self._motion = ContactForce(slider)
        for solver in self.solvers:
            solver.limit(_limited(slider))

    def change(self, settings: ControllerSettings) -> None:
        """See `Steering.change`."""
        self._settings = settings
        for solver in self.solvers:
            solver.weigh(_weights(settings, self._space))

    def bounded(self, staged: StagedPlan) -> StagedPlan:
        """See `Steering.bounded`."""
        stages = [
            stages.within(
                _limits(self._settings, self._motion, staged.contact, staged.mean_input, mode)
            )
            for stages, mode in zip(staged.stages, FAMILY, strict=True)
        ]
        return replace(staged, stages=tuple(stages))

    def prepare(self, staged: StagedPlan, samples: Array) -> None:
        """See `Steering.prepare`."""
        dynamics = self._iteration.prepare(staged, samples)
        sticking = staged.stages[0]
        for solver, first in zip(self.solvers, staged.stages, strict=True):
            solver.prepare(sticking, samples[:-1], first, dynamics)

    def forget(self) -> None:
        """See `Steering.forget`."""
        self._iteration.forget()
        for solver in self.solvers:
            solver.forget()

    def solve(
        self,
        staged: StagedPlan,
        state: Array,
        deviation: Array,
        time: float,
        widening: float,
        disturbance: Array,
        sent: Array,
    ) -> Move:
        """See `Steering.solve`."""
        nominal = staged.plan.at(time)[1]
        before = self._motion.input_of(state[3], *sent.tolist()) - nominal
        solutions = [each.solve(deviation, widening, disturbance, before) for each in self.solvers]
        index, best = min(enumerate(solutions), key=_rank)
        self.mode = FAMILY[index]
        self._iteration.keep(best)
        velocity = self._within_limit(
            self._motion.tip_velocity(state[3], nominal + best.inputs[0])
        )
        iterations = sum(solution.iterations for solution in solutions)
        fault = '' if best.usable else self.solvers[index].largest_violation()
        return Move(velocity, best.status, iterations, fault, best.states)

    def _within_limit(self, velocity: Array) -> Array:
        """A tip velocity (2,) slowed down to the largest v_n.

        The QP bounds the force at the planned p_y, not the speed at the measured one. The
        direction stays, and with it the contact mode.
        """
        return velocity / max(1.0, float(velocity[0]) / self._settings.normal_speed_limit)


def _limits(
    settings: ControllerSettings,
    motion: ContactForce,
    contact: Array,
    forces: Array,
    mode: ContactMode,
) -> tuple[Array, Array]:
    """Lowest and highest deviations (n, 5) of p_y and of the limited inputs."""
    slider = motion.slider
    nominal = np.column_stack([contact, forces @ _limited(slider).T])
    slip = settings.tangential_speed_limit
    # p_y, f_n, f_t - mu f_n, f_t + mu f_n, slip
    low = np.array([-0.5 * slider.side, 0.0, -np.inf, 0.0, 0.0])
    high = np.tile([0.5 * slider.side, 0.0, 0.0, np.inf, 0.0], (len(nominal), 1))
    high[:, 1] = motion.normal_force(contact, settings.normal_speed_limit)
    if mode == ContactMode.SLIDING_LEFT:
        low[2], high[:, 4] = 0.0, slip
    if mode == ContactMode.SLIDING_RIGHT:
        high[:, 3], low[4] = 0.0, -slip
    return low - nominal, high - nominal


def _weights(settings: ControllerSettings, space: InputSpace) -> QPWeights:
    weights = settings.force_weights
    return QPWeights(
        np.array([weights.position_x, weights.position_y, weights.heading, weights.contact]),
        np.array([weights.normal, weights.tangential, weights.slip]),
        weights.change * (_SPEED / space.scale) ** 2,
        np.zeros(space.size),
    )


def _limited(slider: Slider) -> Array:
    """Combinations (4, 3) of the inputs: f_n, both sides of the friction cone, the slip."""
    friction = slider.friction_pusher
    return np.array([[1, 0, 0], [-friction, 1, 0], [friction, 1, 0], [0, 0, 1]], dtype=float)


def _space(slider: Slider) -> InputSpace:
    force = _SPEED / LimitSurface.of(slider).weights[0]
    return InputSpace(
        np.array([force, force, _SPEED]),
        _limited(slider),
        np.array([force, force, force, _SPEED]),
        ('f_n', 'f_t - mu f_n', 'f_t + mu f_n', 'slip [m/s]'),
    )


def _rank(candidate: tuple[int, Solution]) -> tuple[bool, bool, float]:
    """Sorts solutions: usable ones first, then solved ones, then by cost."""
    solution = candidate[1]
    return not solution.usable, solution.status != _SOLVED, solution.cost
