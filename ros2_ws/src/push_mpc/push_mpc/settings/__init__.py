"""Settings of the controller and of its node."""

from push_mpc.settings.controller_settings import ControllerSettings, change_share
from push_mpc.settings.controllers import CONTROLLERS
from push_mpc.settings.diagnostics_settings import DiagnosticsSettings
from push_mpc.settings.guard_settings import GuardSettings
from push_mpc.settings.node_settings import MpcSettings, is_changeable, mpc_settings
from push_mpc.settings.pose_gate_settings import PoseGateSettings
from push_mpc.settings.presets import PRESETS
from push_mpc.settings.recontact import approach, departure, is_apart

__all__ = [
    'CONTROLLERS',
    'PRESETS',
    'ControllerSettings',
    'DiagnosticsSettings',
    'GuardSettings',
    'MpcSettings',
    'PoseGateSettings',
    'approach',
    'change_share',
    'departure',
    'is_apart',
    'is_changeable',
    'mpc_settings',
]
