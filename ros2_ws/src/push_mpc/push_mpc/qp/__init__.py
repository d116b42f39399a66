"""The QP of one tick: linearised stages, cost, constraints, solver."""
