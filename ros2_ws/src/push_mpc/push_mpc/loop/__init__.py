"""The 10 ms loop: one call per tick, without ROS."""

from push_mpc.loop.controller import Controller
from push_mpc.loop.modes import FOLLOWING, MOVING, Mode, state_diagram
from push_mpc.loop.prepared_model import PreparedModel
from push_mpc.loop.start_check import here_fault, start_fault
from push_mpc.loop.tick import Tick

__all__ = [
    'FOLLOWING',
    'MOVING',
    'Controller',
    'Mode',
    'PreparedModel',
    'Tick',
    'here_fault',
    'start_fault',
    'state_diagram',
]
