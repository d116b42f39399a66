"""A table of pushes at the speed of a plan, from one of slow pushes."""

from push_core.physics import Slider, with_inertia

from push_mpc.table.surrogate import Table


def table_at_speed(table: Table, slider: Slider, speed: float) -> Table:
    """The table of an object that is pushed at a speed [m/s]; see `with_inertia`."""
    p_y, beta = table.grid.points()
    return Table(table.grid, *with_inertia(slider, speed, p_y, *table.evaluate(p_y, beta)))
