"""Low-rank kernels: Chebyshev modes of the kernel, for large training sets."""

from push_gp.low_rank.chebyshev import Interval
from push_gp.low_rank.domain import CENTRE, COVERED, INTERVALS, covers
from push_gp.low_rank.folded_process import Process, conditioned

__all__ = ['CENTRE', 'COVERED', 'INTERVALS', 'Interval', 'Process', 'conditioned', 'covers']
