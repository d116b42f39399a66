"""Replay of a bag: publishing its messages, or recomputing its commands."""

from push_bag.replay.live_graph import check_graph, is_command, unless_a_plant_listens
from push_bag.replay.playback import Publishers, from_time, in_order, play
from push_bag.replay.recompute import Changes, Recomputed, recomputed, solved_again
from push_bag.replay.survey import Survey, survey

__all__ = [
    'Changes',
    'Publishers',
    'Recomputed',
    'Survey',
    'check_graph',
    'from_time',
    'in_order',
    'is_command',
    'play',
    'recomputed',
    'solved_again',
    'survey',
    'unless_a_plant_listens',
]
