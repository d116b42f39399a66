"""A run as one table: one row per tick of the controller, columns in SI units."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from push_core.common import InputError
from push_node import interface

from push_bag.run import Floats, Nanoseconds, Reference, RunSeries, Stamped
from push_bag.score.contact import contact
from push_bag.score.reasons import topic_reason
from push_bag.score.tracking import Tracking, tracking_errors

TickTable: TypeAlias = dict[str, NDArray[np.float64] | NDArray[np.int64]]
COUNTS = ('mode', 'iterations', 'solver_status', 'limited')


def tick_table(run: RunSeries) -> TickTable:
    """Columns (n,) by name; NaN where a tick has no such value.

    Raises:
        InputError: the run holds no tick or no reference.
    """
    stamp, reference_time = run.states.stamp, run.state('reference_time')
    if not stamp.size:
        raise InputError(topic_reason(run.types, interface.CONTROLLER_STATE))
    if run.reference is None:
        raise InputError(topic_reason(run.types, interface.NOMINAL_TRAJECTORY))
    return {
        't_s': (stamp - stamp[0]) * 1e-9,
        'stamp_ns': stamp,
        'reference_time_s': np.where(np.isfinite(reference_time), reference_time, np.nan),
        **_measured(run),
        **_errors(tracking_errors(run, run.reference), stamp),
        **_contact(run, run.reference, stamp),
        **{name: run.state(name) for name in ('v_n', 'v_t', 'nominal_v_n', 'nominal_v_t')},
        'solve_s': run.state('solve_ms') * 1e-3,
        'tick_s': run.state('tick_ms') * 1e-3,
        **{name: run.state(name).astype(np.int64) for name in COUNTS},
    }


def _measured(run: RunSeries) -> TickTable:
    stamp = run.states.stamp
    x, y, theta = _at(run.object, stamp).T
    tip_x, tip_y = _at(run.pusher, stamp).T
    command_x, command_y = _at(run.commands, stamp).T
    return {
        **{'object_x_m': x, 'object_y_m': y, 'object_theta_rad': theta},
        **{'tip_x_m': tip_x, 'tip_y_m': tip_y},
        **{'command_x_m_s': command_x, 'command_y_m_s': command_y},
    }


def _errors(tracking: Tracking, stamp: Nanoseconds) -> TickTable:
    values = np.column_stack(
        [tracking.reference, tracking.distance, tracking.cross_track, tracking.heading]
    )
    names = (
        *('reference_x_m', 'reference_y_m', 'reference_theta_rad'),
        *('tracking_error_m', 'cross_track_m', 'heading_error_rad'),
    )
    columns = _at(Stamped(tracking.stamp, tracking.stamp, values), stamp).T
    return dict(zip(names, columns, strict=True))


def _contact(run: RunSeries, reference: Reference, stamp: Nanoseconds) -> TickTable:
    touching = contact(run, reference)
    values = np.column_stack([touching.p_y, touching.gap])
    p_y, gap = _at(Stamped(touching.stamp, touching.stamp, values), stamp).T
    return {'p_y_m': p_y, 'gap_m': gap}


def _at(rows: Stamped, stamp: Nanoseconds) -> Floats:
    """The values (n, k) at these stamps (n,); NaN where there are none."""
    values = np.full((stamp.size, rows.values.shape[1]), np.nan)
    index, exists = rows.at(stamp)
    values[exists] = rows.values[index[exists]]
    return values
