"""A model as the loop uses it: table, plan, and the QP data along the plan."""

from dataclasses import dataclass, replace

from push_core.physics import INERTIA_FROM, Slider, slider_at_speed

from push_mpc.plan import Placement, Plan
from push_mpc.qp import StagedPlan
from push_mpc.settings import CONTROLLERS, ControllerSettings
from push_mpc.table import Table, table_at_speed


@dataclass(frozen=True)
class PreparedModel:
    """What is computed once for each plan and model.

    Attributes:
        table: the model.
        plan: made with it.
        staged: QP data along the plan.
        model_id: of the model, and of what laps have taught beside it.
        slider: whose friction and support radius the QPs take.
    """

    table: Table
    plan: Plan
    staged: StagedPlan
    model_id: str
    slider: Slider

    def placed(self, placement: Placement) -> 'PreparedModel':
        """The same with the plan moved."""
        return replace(
            self,
            plan=placement.of(self.plan),
            staged=self.staged.placed(placement),
        )


def at_speed(
    table: Table, settings: ControllerSettings, slider: Slider, speed: float, identified: bool
) -> tuple[Table, Slider]:
    """Model and slider of slow pushes as they are at a speed [m/s]; see `with_inertia`.

    What laps have identified always has the inertia that was taken from their pushes. The nominal
    slider of the Family of Modes is fitted to pushes of little rotation, and goes without.
    """
    trained = CONTROLLERS[settings.controller].trained_model
    if not (trained or identified) or speed < INERTIA_FROM:
        return table, slider
    return table_at_speed(table, slider, speed), slider_at_speed(slider, speed)
