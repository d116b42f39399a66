"""The controllers: nominal plan, tabulated model, delay predictor, tracking QP."""

from typing import TYPE_CHECKING

from push_core.lazy import lazy_exports

if TYPE_CHECKING:
    from push_mpc.loop import Controller as Controller
    from push_mpc.loop import Mode as Mode
    from push_mpc.loop import Tick as Tick
    from push_mpc.plan import Plan as Plan
    from push_mpc.plan import planned as planned
    from push_mpc.settings import ControllerSettings as ControllerSettings
    from push_mpc.settings import MpcSettings as MpcSettings
    from push_mpc.settings import mpc_settings as mpc_settings
    from push_mpc.table import Table as Table
else:
    __getattr__, __dir__, __all__ = lazy_exports(
        __name__,
        {
            'loop': ['Controller', 'Mode', 'Tick'],
            'plan': ['Plan', 'planned'],
            'settings': ['ControllerSettings', 'MpcSettings', 'mpc_settings'],
            'table': ['Table'],
        },
    )
