"""Other QP solvers and GP libraries, for comparison."""

from push_bringup.rivals.model_rivals import Fitted, fit_gpytorch, fit_ours, fit_scikit_learn
from push_bringup.rivals.qp_recording import recorded
from push_bringup.rivals.qp_solvers import IN_SI_UNITS, SOLVERS, Solver, exact

__all__ = [
    'IN_SI_UNITS',
    'SOLVERS',
    'Fitted',
    'Solver',
    'exact',
    'fit_gpytorch',
    'fit_ours',
    'fit_scikit_learn',
    'recorded',
]
