"""The console scripts of this package."""

from push_core.console import console_script

recorder = console_script('push_bag.record.recorder')
score = console_script('push_bag.commands.score')
info = console_script('push_bag.commands.info')
replay = console_script('push_bag.commands.replay')
live = console_script('push_bag.commands.live')
markers = console_script('push_bag.commands.markers')
recover = console_script('push_bag.repair.recover')
export = console_script('push_bag.commands.export')
import_csv = console_script('push_bag.commands.import_csv')
