"""Recorder, reader, replay, score and report of runs in MCAP bags."""

from typing import TYPE_CHECKING

from push_core.lazy import lazy_exports

if TYPE_CHECKING:
    from push_bag.file import BagReader as BagReader
    from push_bag.file import Record as Record
    from push_bag.run import Reference as Reference
    from push_bag.run import RunSeries as RunSeries
    from push_bag.run import Stamped as Stamped
    from push_bag.run import read_run as read_run
    from push_bag.score import Tracking as Tracking
    from push_bag.score import score_run as score_run
    from push_bag.score import score_series as score_series
    from push_bag.score import tracking_errors as tracking_errors
else:
    __getattr__, __dir__, __all__ = lazy_exports(
        __name__,
        {
            'file': ['BagReader', 'Record'],
            'run': ['Reference', 'RunSeries', 'Stamped', 'read_run'],
            'score': ['Tracking', 'score_run', 'score_series', 'tracking_errors'],
        },
    )
