"""Publishing a bag again, and computing its commands again."""

from push_bag.replay.playback import Publishers, in_order, play, skipped_to
from push_bag.replay.recompute import Changes, Recomputed, recomputed
from push_bag.replay.survey import Survey, survey

__all__ = [
    'Changes',
    'Publishers',
    'Recomputed',
    'Survey',
    'in_order',
    'play',
    'recomputed',
    'skipped_to',
    'survey',
]
