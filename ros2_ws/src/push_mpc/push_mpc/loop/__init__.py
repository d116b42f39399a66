"""The 10 ms loop: one call per tick, without ROS."""

from push_mpc.loop.controller import Controller, PreparedModel
from push_mpc.loop.start_check import start_fault
from push_mpc.loop.tick import FOLLOWING, Mode, Tick

__all__ = ['FOLLOWING', 'Controller', 'Mode', 'PreparedModel', 'Tick', 'start_fault']
