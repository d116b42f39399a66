"""Low-rank kernels: Chebyshev modes of the kernel, for large training sets."""

from push_gp.low_rank.chebyshev import CENTRE, HALF_WIDTH, INTERVALS, Interval, covers
from push_gp.low_rank.kernel_modes import KernelModes
from push_gp.low_rank.low_rank_process import Process, conditioned

__all__ = [
    'CENTRE',
    'HALF_WIDTH',
    'INTERVALS',
    'Interval',
    'KernelModes',
    'Process',
    'conditioned',
    'covers',
]
