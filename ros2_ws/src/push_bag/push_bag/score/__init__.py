"""The score of a run: tracking, contact, timing, messages."""

from push_bag.score.bounds import bound, check_bounds
from push_bag.score.changes import changes_in_words
from push_bag.score.contact import Contact, contact, loss_intervals
from push_bag.score.runs_table import Scores, comparison_table, runs_object, runs_table
from push_bag.score.score import bag_score, score_run, score_series
from push_bag.score.score_table import messages_line, score_rows, score_table
from push_bag.score.tick_table import TickTable, tick_table
from push_bag.score.timing import DEADLINE, LoopTiming, timing
from push_bag.score.tracking import (
    Tracking,
    during_tracking,
    reference_times,
    tracking_errors,
)

__all__ = [
    'DEADLINE',
    'Contact',
    'LoopTiming',
    'Scores',
    'TickTable',
    'Tracking',
    'bag_score',
    'bound',
    'changes_in_words',
    'check_bounds',
    'comparison_table',
    'contact',
    'during_tracking',
    'loss_intervals',
    'messages_line',
    'reference_times',
    'runs_object',
    'runs_table',
    'score_rows',
    'score_run',
    'score_series',
    'score_table',
    'tick_table',
    'timing',
    'tracking_errors',
]
