"""Other QP solvers and GP libraries, for comparison."""
