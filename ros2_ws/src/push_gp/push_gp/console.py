"""The console scripts of this package."""

from push_core.console import console_script

gp_server = console_script('push_gp.server.gp_server')
train = console_script('push_gp.commands.train')
curve = console_script('push_gp.commands.curve')
evaluate = console_script('push_gp.commands.evaluate')
