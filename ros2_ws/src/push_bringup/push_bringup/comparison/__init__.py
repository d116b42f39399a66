"""Other QP solvers and GP libraries, for comparison."""

from push_bringup.comparison.gp_libraries import (
    LibraryFit,
    fit_gpytorch,
    fit_ours,
    fit_scikit_learn,
)
from push_bringup.comparison.qp_recording import recorded_problems
from push_bringup.comparison.qp_solvers import IN_SI_UNITS, SOLVERS, Solver, exact

__all__ = [
    'IN_SI_UNITS',
    'SOLVERS',
    'LibraryFit',
    'Solver',
    'exact',
    'fit_gpytorch',
    'fit_ours',
    'fit_scikit_learn',
    'recorded_problems',
]
