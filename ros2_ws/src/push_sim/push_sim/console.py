"""The console scripts of this package."""

from push_core.console import console_script

sim_node = console_script('push_sim.node.sim_node')
bench = console_script('push_sim.commands.bench')
collect = console_script('push_sim.commands.collect')
validate = console_script('push_sim.commands.validate')
calibrate = console_script('push_sim.commands.calibrate')
