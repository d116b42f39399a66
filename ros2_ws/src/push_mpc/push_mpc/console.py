"""The console scripts of this package."""

from push_core.console import console_script

mpc_node = console_script('push_mpc.node.mpc_node')
