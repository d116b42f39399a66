"""The console scripts of this package."""

from push_core.console import console_script

bench = console_script('push_bringup.commands.bench')
cell = console_script('push_bringup.commands.cell')
check_driver = console_script('push_bringup.commands.check_driver')
faults = console_script('push_bringup.commands.faults')
parameters = console_script('push_bringup.commands.parameters')
start = console_script('push_bringup.commands.start')
